#include "engine/calibration/frame_information.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "engine/geometry/rotation.h"

namespace helical {
namespace {

/// The helicopter's perturbation (order of TrackedState) that to the image is the camera's.
Matrix6d poseFromCamera(const RigidTransform& camera_from_world, const RigidTransform& world_from_body) {
  const Eigen::Matrix3d world_from_camera = camera_from_world.rotation.toRotationMatrix().transpose();
  const Eigen::Vector3d reach = world_from_body.translation - camera_from_world.inverseTranslation();
  Matrix6d map = Matrix6d::Zero();
  map.topLeftCorner<3, 3>() = -hat(reach) * world_from_camera;
  map.topRightCorner<3, 3>() = -Eigen::Matrix3d::Identity();
  map.bottomLeftCorner<3, 3>() = world_from_body.rotation.toRotationMatrix().transpose() * world_from_camera;
  return map;
}

}  // namespace

FrameInformation frameInformation(const CameraModel& camera, const MarkerLayout& markers,
                                  const StoredFrame& frame, const RigidTransform& camera_from_world,
                                  const RobustWeights& weights) {
  FrameInformation result;
  const Matrix6d map = poseFromCamera(camera_from_world, frame.world_from_body);
  const Vector6d ahead = map * weights.ahead;
  const Eigen::Matrix3d rotation = camera_from_world.rotation.toRotationMatrix();
  const Eigen::Matrix3d body = frame.world_from_body.rotation.toRotationMatrix();
  // A turn by a random rotation vector e of covariance P shortens an arm on average: E[exp(e)] = I + (P - tr(P) I) / 2.
  // Without that the balls seem to lie nearer together than they should, and the camera farther away.
  const Eigen::Matrix3d turned = frame.pose_covariance.bottomRightCorner<3, 3>();
  const Eigen::Matrix3d mean_body =
      body + 0.5 * body * (turned - turned.trace() * Eigen::Matrix3d::Identity());
  Matrix6d information = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  std::array<double, kMaxMarkers> distances;
  int seen_count = 0;
  for (int i = 0; i < frame.count; ++i) {
    const LabelledPixel& seen = frame.pixels[static_cast<std::size_t>(i)];
    const Eigen::Vector3d& marker = markers.inBody(seen.marker);
    const Eigen::Vector3d arm = mean_body * marker;
    Eigen::Matrix<double, 2, 3> d_point;
    const auto pixel = camera.project(
        rotation * (arm + frame.world_from_body.translation) + camera_from_world.translation, &d_point);
    if (!pixel) continue;
    Eigen::Matrix<double, 2, 6> d_pose;
    d_pose.leftCols<3>().noalias() = d_point * rotation;
    d_pose.rightCols<3>().noalias() = -d_pose.leftCols<3>() * (body * hat(marker));
    const Eigen::Vector2d residual = *pixel - seen.pixel;
    const Eigen::Vector2d expected = residual + d_pose * ahead;
    const Eigen::Matrix2d allowed = seen.covariance + d_pose * frame.pose_covariance * d_pose.transpose();
    const double squared = expected.dot(allowed.inverse() * expected);
    const double ratio = weights.sigmas * weights.sigmas / std::max(squared, 1e-12);
    const double weight = ratio >= 1.0 ? 1.0 : ratio * ratio;
    result.inliers += ratio >= 1.0;
    distances[static_cast<std::size_t>(seen_count++)] = squared;
    const Eigen::Matrix<double, 6, 2> weighted = weight * d_pose.transpose() * seen.covariance.inverse();
    information.noalias() += weighted * d_pose;
    gradient.noalias() += weighted * residual;
  }
  if (seen_count == 0) return result;
  const auto middle = distances.begin() + seen_count / 2;
  std::nth_element(distances.begin(), middle, distances.begin() + seen_count);
  result.median_sigmas = std::sqrt(*middle);

  Matrix6d inner = Matrix6d::Identity();
  inner.noalias() += information * frame.pose_covariance;
  const Eigen::PartialPivLU<Matrix6d> solver(inner);
  const Matrix6d marginal = solver.solve(information);
  result.hessian.noalias() = map.transpose() * (0.5 * (marginal + marginal.transpose())) * map;
  result.gradient.noalias() = map.transpose() * solver.solve(gradient);
  return result;
}

}  // namespace helical
