#include "engine/calibration/cramer_rao.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "engine/calibration/camera_perturbation.h"

namespace helical {
namespace {

constexpr double kSingular = 1e-12;  // smallest pivot over the largest

bool determined(const Eigen::LDLT<Matrix6d>& factor) {
  const Vector6d pivots = factor.vectorD();
  return factor.info() == Eigen::Success && pivots.allFinite() && pivots.maxCoeff() > 0.0 &&
         pivots.minCoeff() > kSingular * pivots.maxCoeff();
}

}  // namespace

Matrix6d poseInformation(const CameraModel& camera, const RigidTransform& camera_from_world,
                         const MarkerLayout& markers, std::span<const MarkerId> seen,
                         const RigidTransform& world_from_body, double sigma_px) {
  Matrix6d information = Matrix6d::Zero();
  for (const MarkerId marker : seen) {
    const auto ball = projectMarker(camera, camera_from_world, world_from_body, markers.inBody(marker));
    if (!ball || !camera.contains(ball->pixel)) continue;
    information.noalias() += ball->d_pose.transpose() * ball->d_pose;
  }
  return information / (sigma_px * sigma_px);
}

void CramerRaoBound::add(const CameraModel& camera, const RigidTransform& camera_from_world,
                         const MarkerLayout& markers, std::span<const MarkerId> seen,
                         const RigidTransform& world_from_body, const Matrix6d& pose_information,
                         double sigma_px, double frames) {
  const double weight = 1.0 / (sigma_px * sigma_px);
  Matrix6d camera_camera = Matrix6d::Zero(), pose_camera = Matrix6d::Zero(), pose_pose = pose_information;
  for (const MarkerId marker : seen) {
    const auto ball = projectMarker(camera, camera_from_world, world_from_body, markers.inBody(marker));
    if (!ball || !camera.contains(ball->pixel)) continue;
    camera_camera.noalias() += weight * ball->d_camera.transpose() * ball->d_camera;
    pose_camera.noalias() += weight * ball->d_pose.transpose() * ball->d_camera;
    pose_pose.noalias() += weight * ball->d_pose.transpose() * ball->d_pose;
  }
  // A pose that this frame leaves open takes all that its balls could say about the camera.
  const Eigen::LDLT<Matrix6d> factor(pose_pose);
  if (!determined(factor)) return;
  information_ += frames * camera_camera;
  information_.noalias() -= frames * pose_camera.transpose() * factor.solve(pose_camera);
}

std::optional<CalibrationBound> CramerRaoBound::bound() const {
  const Eigen::LDLT<Matrix6d> factor(information_);
  if (!determined(factor)) return std::nullopt;
  const Matrix6d covariance = factor.solve(Matrix6d::Identity());
  return CalibrationBound{std::sqrt(covariance.bottomRightCorner<3, 3>().trace()),
                          std::sqrt(covariance.topLeftCorner<3, 3>().trace())};
}

}  // namespace helical
