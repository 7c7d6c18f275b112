#pragma once

#include <Eigen/Core>

#include "engine/geometry/camera_estimate.h"
#include "engine/geometry/rigid_transform.h"
#include "engine/geometry/rotation.h"

namespace helical {

/// Derivatives of a predicted pixel: by CameraEstimate's perturbation of the camera, and by the item: a point
/// in the world, or a body's pose (rotation on the left of `world_from_body`, then shift, both in the world).
struct SightingDerivatives {
  Eigen::Matrix<double, 2, 6> camera;
  Eigen::Matrix<double, 2, 3> point;
  Eigen::Matrix<double, 2, 6> body;
};

/// `d_pixel_d_camera_point` is the camera model's; `arm` the body's point turned into the world.
inline SightingDerivatives sightingDerivatives(const RigidTransform& camera_from_world,
                                               const Eigen::Vector3d& point_in_world,
                                               const Eigen::Vector3d& arm,
                                               const Eigen::Matrix<double, 2, 3>& d_pixel_d_camera_point) {
  const Eigen::Matrix3d rotation = camera_from_world.rotation.toRotationMatrix();
  SightingDerivatives d;
  d.point = d_pixel_d_camera_point * rotation;
  d.camera.leftCols<3>() = -d_pixel_d_camera_point * hat(camera_from_world * point_in_world);
  d.camera.rightCols<3>() = -d.point;
  d.body.leftCols<3>() = -d.point * hat(arm);
  d.body.rightCols<3>() = d.point;
  return d;
}

}  // namespace helical
