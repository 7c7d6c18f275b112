#pragma once

#include "engine/calibration/frame_store.h"
#include "engine/geometry/camera_model.h"
#include "engine/helicopter/marker_layout.h"

namespace helical {

/// What one frame says about a camera: normal equations of its perturbation (order of CameraEstimate), with
/// the helicopter's pose marginalised (Schur complement).
struct FrameInformation {
  Matrix6d hessian = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();  ///< of half the cost
  int inliers = 0;                       ///< balls with full weight
  double median_sigmas = 0.0;            ///< of the residuals (the upper of two); 0 without balls
};

/// At what residual a ball begins to count less, and where the camera is taken to be for that.
struct RobustWeights {
  double sigmas = 4.0;                ///< weight 1 up to here, (this / residual)^4 beyond
  Vector6d ahead = Vector6d::Zero();  ///< perturbation from the linearisation to the best estimate
};

/// Linearised at `camera_from_world`. A residual is judged by what centroid and helicopter pose together
/// allow. Allocates nothing.
///
/// To one frame moving the camera is moving the helicopter the other way: d_camera = d_pose T. With A and g
/// the normal equations of the pose and P its covariance, the marginal ones are T' (I + A P)^-1 A T and
/// T' (I + A P)^-1 g, which also holds for P = 0.
FrameInformation frameInformation(const CameraModel& camera, const MarkerLayout& markers,
                                  const StoredFrame& frame, const RigidTransform& camera_from_world,
                                  const RobustWeights& weights = {});

}  // namespace helical
