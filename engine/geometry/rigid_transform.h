#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace helical {

/// A rigid transform, named by its frames: `a_from_b * point_in_b` is the point in a, and
/// `a_from_b * b_from_c == a_from_c`.
struct RigidTransform {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< unit
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();         ///< metres

  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const { return rotation * point + translation; }
  RigidTransform operator*(const RigidTransform& b_from_c) const {
    return {(rotation * b_from_c.rotation).normalized(), rotation * b_from_c.translation + translation};
  }
  RigidTransform inverse() const {
    const Eigen::Quaterniond back = rotation.conjugate();
    return {back, -(back * translation)};
  }
  /// The origin of frame a, in b: of `camera_from_world` it is the camera's centre in the world.
  Eigen::Vector3d inverseTranslation() const { return -(rotation.conjugate() * translation); }
};

}  // namespace helical
