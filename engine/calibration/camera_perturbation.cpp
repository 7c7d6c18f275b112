#include "engine/calibration/camera_perturbation.h"

#include <string>

#include "engine/base/error.h"
#include "engine/geometry/rotation.h"

namespace helical {

void validate(const GuessSpread& spread) {
  if (!(spread.rotation_rad > 0.0 && spread.rotation_rad <= kPi))
    throw Error(ErrorKind::kInput, "rotation_rad of the guess is " + std::to_string(spread.rotation_rad), {},
                "give an angle above 0, at most pi");
  if (!(spread.position_m > 0.0 && spread.position_m <= 100.0))
    throw Error(ErrorKind::kInput, "position_m of the guess is " + std::to_string(spread.position_m), {},
                "give a distance above 0, at most 100 m");
}

Matrix6d covarianceOf(const GuessSpread& spread) {
  Matrix6d covariance = Matrix6d::Zero();
  covariance.diagonal().head<3>().setConstant(spread.rotation_rad * spread.rotation_rad / 3.0);
  covariance.diagonal().tail<3>().setConstant(spread.position_m * spread.position_m / 3.0);
  return covariance;
}

std::optional<MarkerProjection> projectMarker(const CameraModel& camera,
                                              const RigidTransform& camera_from_world,
                                              const RigidTransform& world_from_body,
                                              const Eigen::Vector3d& marker_in_body) {
  const Eigen::Vector3d in_camera = camera_from_world * (world_from_body * marker_in_body);
  Eigen::Matrix<double, 2, 3> d_point;
  const auto pixel = camera.project(in_camera, &d_point);
  if (!pixel) return std::nullopt;
  MarkerProjection projection;
  projection.pixel = *pixel;
  const Eigen::Matrix<double, 2, 3> d_world = d_point * camera_from_world.rotation.toRotationMatrix();
  projection.d_camera.leftCols<3>() = -d_point * hat(in_camera);
  projection.d_camera.rightCols<3>() = -d_world;
  projection.d_pose.leftCols<3>() = d_world;
  projection.d_pose.rightCols<3>() =
      -d_world * world_from_body.rotation.toRotationMatrix() * hat(marker_in_body);
  return projection;
}

}  // namespace helical
