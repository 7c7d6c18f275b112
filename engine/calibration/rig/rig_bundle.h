#pragma once

#include <span>

#include "engine/calibration/rig/free_body.h"
#include "engine/calibration/rig/rig_state.h"

namespace helical {

struct BundleOptions {
  double robust_scale_px = 0.0;  ///< Cauchy's; 0 is plain least squares
  int max_iterations = 100;
  bool only_cameras = false;  ///< items stay where they are
  /// If given, one of each camera [s]: how much later than the table says it saw is found as well, with
  /// pixels of standard deviation `sigma_px`. That of the camera whose pose holds the world is zero.
  std::vector<double>* late_s = nullptr;
  double sigma_px = 0.0;
  bool take_back_averaging = false;  ///< see noiseAfterDelay(): where residuals are noise
  FreeBody* free_body = nullptr;     ///< is solved for, too
};

/// Bundle adjustment over the sightings that are inliers: cameras that are not fixed, and the points or body
/// poses (Ceres, Schur complement). With no camera fixed the first one that has a pose stays where it is.
/// Returns the final cost [px^2]. Repeats bit for bit.
double adjustBundle(RigState& state, std::span<const RigCamera> cameras, const SightingTable& table,
                    const BundleOptions& options);

}  // namespace helical
