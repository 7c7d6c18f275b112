#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "engine/base/ids.h"
#include "engine/geometry/camera_estimate.h"
#include "engine/geometry/camera_model.h"
#include "engine/helicopter/marker_layout.h"

namespace helical {

/// What one camera's view of some balls says about the helicopter's pose (order of TrackedState): the sum
/// over the calibrated cameras is what a bound needs. Balls outside the image count for nothing.
Matrix6d poseInformation(const CameraModel& camera, const RigidTransform& camera_from_world,
                         const MarkerLayout& markers, std::span<const MarkerId> seen,
                         const RigidTransform& world_from_body, double sigma_px);

/// The best that any unbiased estimator can do: root of the trace of the position's and of the rotation's
/// covariance.
struct CalibrationBound {
  double position_m = 0.0;
  double orientation_rad = 0.0;
};

/// Cramer-Rao bound of one fixed camera's extrinsics (order of CameraEstimate) from the frames added so far,
/// each with a helicopter pose of its own that is marginalised (Schur complement). Linearised at the poses
/// given: the true ones in simulation, the estimated ones live. Allocates nothing.
class CramerRaoBound {
 public:
  /// One frame, or `frames` alike: the balls that the camera saw with `sigma_px` per axis, and what is known
  /// of the helicopter's pose from elsewhere.
  void add(const CameraModel& camera, const RigidTransform& camera_from_world, const MarkerLayout& markers,
           std::span<const MarkerId> seen, const RigidTransform& world_from_body,
           const Matrix6d& pose_information, double sigma_px, double frames = 1.0);

  const Matrix6d& information() const { return information_; }

  /// Nothing while the frames do not determine the camera.
  std::optional<CalibrationBound> bound() const;

 private:
  Matrix6d information_ = Matrix6d::Zero();
};

}  // namespace helical
