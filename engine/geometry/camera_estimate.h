#pragma once

#include <Eigen/Core>

#include "engine/geometry/rigid_transform.h"

namespace helical {

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// Whether a camera may be believed. Only `calibration` (or, for a rig file's given poses, `pipeline` at
/// start) sets it; everybody reads it.
enum class CameraStatus {
  kUncalibrated,  ///< no pose at all
  kCalibrating,   ///< a pose that is not yet good enough to fly on
  kCalibrated,    ///< in the control set
  kRejected,      ///< was calibrated, now disagrees (knocked)
};

/// What is known of a camera's place. Perturbations are 6-vectors (rotation on the left of
/// `camera_from_world` in the camera frame [rad], then the shift of the camera's centre in the world [m]);
/// `covariance` is theirs.
struct CameraEstimate {
  RigidTransform camera_from_world;
  Matrix6d covariance = Matrix6d::Zero();
  CameraStatus status = CameraStatus::kUncalibrated;
};

}  // namespace helical
