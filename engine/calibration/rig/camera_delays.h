#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/calibration/rig/rig_camera.h"
#include "engine/calibration/rig/sightings.h"

namespace helical {

/// How much later than its time stamps say each camera saw: cameras that nothing triggers expose up to a
/// period apart, and drivers stamp frames when they arrive. It shows in how what a camera saw lags along its
/// way through the image, which its own track tells: a parabola through neighbouring pixels.

/// Where a sighting's point was `late_s` before.
Eigen::Vector2d pixelBefore(const Sighting& sighting, double late_s);

/// Moves the sightings of every camera to where they were `late_s` (one of each) before, and counts it in
/// `table.late_s`.
void takeOffDelays(SightingTable& table, std::span<const RigCamera> cameras, std::span<const double> late_s);

/// How fast what a camera sees moves through its image [px/s], of each camera the median over its sightings
/// (or the inliers among them) whose motion is known; nothing where there are none.
std::vector<std::optional<double>> medianSpeeds(const SightingTable& table, bool of_inliers);

/// Marks as adrift what has no motion in cameras whose delay usually is worth more than a pixel or two.
void giveUpAdrift(SightingTable& table);

/// Variance of a pixel that was moved along its track by so many periods, over that of one that was not, and
/// its derivative. Between two pixels their noise averages: the residuals of a camera that is moved by half a
/// period shrink, right or wrong, and least squares alone would move all of them.
struct DelayNoise {
  double variance = 1.0, slope = 0.0;  ///< not told beyond a period: zero
};
DelayNoise noiseAfterDelay(Timing timing, double periods);

/// Delays that a track's parabola can tell: more, and what a camera saw belongs to another frame.
constexpr double kDelayReachPeriods = 1.25;

/// Whether a camera's delay is as long as can be told, so that the true one may be longer.
bool beyondDelayReach(const SightingTable& table, std::size_t camera);

/// What share of the inliers' residuals the points' or body poses' own unknowns leave: where two cameras see
/// a light, a quarter.
double freeShare(const SightingTable& table);

/// Whether delays explain more than chance would: residuals (seen less predicted, over their standard
/// deviation, of the same sightings) without and with them, of which the items leave `free_share`.
bool delaysAreReal(std::span<const Eigen::Vector2d> without, std::span<const Eigen::Vector2d> with,
                   double free_share, std::size_t cameras);

}  // namespace helical
