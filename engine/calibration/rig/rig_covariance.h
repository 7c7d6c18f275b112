#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/calibration/rig/free_body.h"
#include "engine/calibration/rig/rig_calibration.h"
#include "engine/calibration/rig/rig_state.h"

namespace helical {

/// Covariance of each solved camera's perturbation (CameraEstimate's), the points or body poses marginalised,
/// from the inliers and the scatter of their residuals. Fixed cameras have none. Without fixed cameras the
/// first solved one is the frame and exact; `distance` (of whichever two cameras) is exact, too, where the
/// scale is not measured. Empty where the recording leaves a camera open. With a free body its points and the
/// focal lengths are unknowns, too, as far as their priors let them.
struct RigCovariance {
  std::vector<std::optional<Matrix6d>> cameras;
  double sigma_px = 0.0;  ///< per axis, by the sum of squares
  std::vector<double>
      focal_sigmas;  ///< of each camera's scale; 0 where it is given; empty without a free body
  std::vector<double> point_sigmas_m;  ///< of each of its points, largest axis; likewise
};

RigCovariance rigCovariance(const RigState& state, std::span<const RigCamera> cameras,
                            const SightingTable& table, const std::optional<KnownDistance>& distance,
                            const FreeBody* free_body = nullptr);

/// What a camera's focal length would be if the recording had a say in it, as a share off the given one, and
/// how far the camera would move then. Wrong focal lengths hide in poses and points: residuals hardly tell.
struct FocalDoubt {
  double off = 0.0;
  double sigma = 0.0;     ///< of that; 0: not told
  double moves_by = 0.0;  ///< in the state's unit of length
};

/// Of each camera, all of them together: one step from where poses and points are best for the given ones.
std::vector<FocalDoubt> doubtFocals(const RigState& state, std::span<const RigCamera> cameras,
                                    const SightingTable& table, const std::optional<KnownDistance>& distance);

}  // namespace helical
