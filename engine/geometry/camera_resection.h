#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "engine/geometry/camera_estimate.h"
#include "engine/geometry/camera_model.h"
#include "engine/geometry/rigid_transform.h"

namespace helical {

/// A point whose place in the world is known and where a camera saw it. Points of several poses of the
/// helicopter are simply more points.
struct WorldPoint {
  Eigen::Vector3d in_world = Eigen::Vector3d::Zero();  ///< metres
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

enum class ResectionMethod {
  kGaussNewton,         ///< full steps, nothing that holds them back: the paper's baseline
  kLevenbergMarquardt,  ///< steps that do not help are damped
  kCeres,               ///< the Ceres solver's Levenberg-Marquardt, on the same residuals
};

enum class ResectionStatus {
  kConverged,
  kIterationLimit,  ///< still moving after `max_iterations`
  kDiverged,        ///< steps out of bounds, or points behind the camera
  kDegenerate,      ///< fewer than 3 points, or points that leave the pose open
};

struct ResectionOptions {
  ResectionMethod method = ResectionMethod::kLevenbergMarquardt;
  int max_iterations = 50;
  double robust_scale_px = 0.0;  ///< residuals beyond it count ever less; 0 is plain least squares
  double sigma_px = 0.5;         ///< of a centroid, per axis; scales the covariance
};

void validate(const ResectionOptions& options);  ///< throws Error(kInput)

/// A camera's pose from points known in the world.
struct Resection {
  RigidTransform camera_from_world;
  Matrix6d covariance = Matrix6d::Zero();  ///< of CameraEstimate's perturbation, for `sigma_px`
  double cost_px2 = 0.0;                   ///< sum of (robust) squared residuals
  double rms_px = 0.0;                     ///< per axis, of the inliers
  int inliers = 0;                         ///< points within `robust_scale_px`, or all that are seen
  int iterations = 0;
  ResectionStatus status = ResectionStatus::kDegenerate;
};

/// Minimises the reprojection error (the paper's problem 1 with intrinsics and points known, eq. 3) over the
/// pose of one camera, from `initial`. Robust cost of a squared residual s beyond k^2: k^2 (2 - k^2 / s),
/// that is the weight (k / r)^4. Allocates nothing unless Ceres is chosen. Never throws; see `status`.
Resection resectCamera(const CameraModel& camera, std::span<const WorldPoint> points,
                       const RigidTransform& initial, const ResectionOptions& options = {});

/// Predicted minus seen pixel of one point and, on demand, its derivative by CameraEstimate's perturbation.
/// Nothing for a point that the camera model cannot project.
std::optional<Eigen::Vector2d> resectionResidual(const CameraModel& camera, const WorldPoint& point,
                                                 const RigidTransform& camera_from_world,
                                                 Eigen::Matrix<double, 2, 6>* jacobian = nullptr);

}  // namespace helical
