#pragma once

#include <Eigen/Core>
#include <optional>

#include "engine/geometry/camera_estimate.h"
#include "engine/geometry/camera_model.h"

namespace helical {

/// How far a guess may be off: standard deviations of its angle and of its distance.
struct GuessSpread {
  double rotation_rad = 0.26;
  double position_m = 0.4;
};

/// Throws Error(kInput) naming the offending key.
void validate(const GuessSpread& spread);

/// Covariance of a camera's perturbation (order of CameraEstimate) with the guess's total variances.
Matrix6d covarianceOf(const GuessSpread& spread);

/// One ball's pixel and how it depends on the camera's perturbation and on the helicopter's pose (order of
/// TrackedState).
struct MarkerProjection {
  Eigen::Vector2d pixel;
  Eigen::Matrix<double, 2, 6> d_camera;
  Eigen::Matrix<double, 2, 6> d_pose;
};

/// Nothing for a ball that the camera cannot see. Allocates nothing.
std::optional<MarkerProjection> projectMarker(const CameraModel& camera,
                                              const RigidTransform& camera_from_world,
                                              const RigidTransform& world_from_body,
                                              const Eigen::Vector3d& marker_in_body);

}  // namespace helical
