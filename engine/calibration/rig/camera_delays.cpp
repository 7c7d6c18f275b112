#include "engine/calibration/rig/camera_delays.h"

#include <algorithm>
#include <cmath>

#include "engine/calibration/rig/quantile.h"

namespace helical {
namespace {

// Twice the log-likelihood that each delay must bring: five standard deviations and a little for the search.
constexpr double kLeastGain = 30.0;
constexpr double kWorthPx = 2.0;

double squares(std::span<const Eigen::Vector2d> residuals) {
  double sum = 0.0;
  for (const Eigen::Vector2d& r : residuals) sum += r.squaredNorm();
  return sum;
}

}  // namespace

Eigen::Vector2d pixelBefore(const Sighting& sighting, double late_s) {
  return sighting.pixel - late_s * sighting.motion.velocity +
         (0.5 * late_s * late_s) * sighting.motion.acceleration;
}

void takeOffDelays(SightingTable& table, std::span<const RigCamera> cameras, std::span<const double> late_s) {
  for (std::size_t c = 0; c < cameras.size(); ++c) table.late_s[c] += late_s[c];
  for (Sighting& s : table.sightings) {
    const auto c = static_cast<std::size_t>(s.camera);
    s.pixel = pixelBefore(s, late_s[c]);
    s.motion.velocity -= late_s[c] * s.motion.acceleration;
    s.bearing = cameras[c].model.bearing(s.pixel);
  }
}

std::vector<std::optional<double>> medianSpeeds(const SightingTable& table, bool of_inliers) {
  std::vector<std::vector<double>> speeds(table.late_s.size());
  for (const Sighting& s : table.sightings)
    if (s.motion.known && (s.inlier || !of_inliers))
      speeds[static_cast<std::size_t>(s.camera)].push_back(s.motion.velocity.norm());
  std::vector<std::optional<double>> medians(speeds.size());
  for (std::size_t c = 0; c < speeds.size(); ++c)
    if (!speeds[c].empty()) medians[c] = quantileOf(speeds[c], 0.5);
  return medians;
}

void giveUpAdrift(SightingTable& table) {
  const auto speeds = medianSpeeds(table, false);
  for (Sighting& s : table.sightings) {
    const auto c = static_cast<std::size_t>(s.camera);
    s.adrift = !s.motion.known && std::abs(table.late_s[c]) * speeds[c].value_or(0.0) > kWorthPx;
  }
}

DelayNoise noiseAfterDelay(Timing timing, double periods) {
  const double square = periods * periods;
  // Pixels that were interpolated lie at any share of their two rows: the mean over it of its squared
  // weights, (1 - share)^2 + share^2, with the share moved by the delay; over that without one, 2/3.
  if (timing == Timing::kInterpolated) return {1.0 + 3.0 * square, 6.0 * periods};
  // Weights of a parabola's three rows: 1 - x^2, (x^2 - x) / 2, (x^2 + x) / 2; the sum of their squares.
  if (square > 1.0) return {};
  return {1.0 + 1.5 * square * (square - 1.0), 3.0 * periods * (2.0 * square - 1.0)};
}

bool beyondDelayReach(const SightingTable& table, std::size_t camera) {
  return !table.late_s.empty() && std::abs(table.late_s[camera]) > 0.99 * kDelayReachPeriods * table.period_s;
}

double freeShare(const SightingTable& table) {
  double residuals = 0.0, unknowns = 0.0;
  std::int32_t item = -1;
  for (const Sighting& s : table.sightings) {
    if (!s.inlier) continue;
    residuals += 2.0;
    if (s.item != item) unknowns += table.kind == TargetKind::kBody ? 6.0 : 3.0;
    item = s.item;
  }
  return residuals > 0.0 ? std::max(0.0, 1.0 - unknowns / residuals) : 0.0;
}

bool delaysAreReal(std::span<const Eigen::Vector2d> without, std::span<const Eigen::Vector2d> with,
                   double free_share, std::size_t cameras) {
  const double before = squares(without), after = squares(with);
  if (!(before > 0.0) || !(after > 0.0)) return false;
  const double gain = 2.0 * free_share * static_cast<double>(with.size()) * std::log(before / after);
  return gain > kLeastGain * static_cast<double>(cameras - 1);
}

}  // namespace helical
