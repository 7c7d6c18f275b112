#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/calibration/rig/free_body.h"
#include "engine/calibration/rig/rig_calibration.h"
#include "engine/calibration/rig/rig_state.h"
#include "engine/calibration/rig/sightings.h"

namespace helical {

/// A rig solved for from one recording.
struct RigSolution {
  std::vector<RigCamera> cameras;
  SightingTable table;
  std::optional<FreeBody> body;  ///< if it is solved for
  RigState state;
  double sigma_px = 0.0;
  double explained = 0.0;  ///< share of sightings
  double gate_px = 0.0;    ///< within which sightings are inliers
  /// By how much more than a frame each camera saw later than its stamps say: found first, and taken off the
  /// stamps. Empty where no camera did.
  std::vector<double> stamps_late_s;
};

/// From nothing, of the likelier timing: the one whose residuals are smaller, if it explains about as much.
/// Delays are sought unless the options trust the stamps, those of more than a frame where cameras do not fit
/// without them. The world is the first solved camera's. Throws as bringTogether() does.
RigSolution solveLikeliest(PointRows rows, std::span<const RigCamera> cameras, const std::string& file,
                           const RigCalibrationOptions& options, const ProgressCallback& progress);

/// Gate and bundle in turn until both have settled; plain least squares at the end.
void refine(RigSolution& s);

/// Of each camera the sightings that twice as wide a gate would let in, over the inliers. Few: what was
/// rejected is something else than the target. As many as inliers: residuals go on beyond the gate, and the
/// solution is hardly one.
std::vector<double> nearMisses(const RigSolution& s);
inline constexpr double kFewNearMisses = 0.2;

}  // namespace helical
