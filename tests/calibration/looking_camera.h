#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "engine/geometry/rigid_transform.h"

namespace helical {

/// A level camera in that direction, that far from a point so high above the world's origin, at which it
/// looks.
inline RigidTransform lookingFrom(double azimuth, double elevation, double distance, double height) {
  const Eigen::Vector3d away(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                             std::sin(elevation));
  const Eigen::Vector3d z = -away, x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d rows;
  rows << x.transpose(), z.cross(x).transpose(), z.transpose();
  RigidTransform pose;
  pose.rotation = Eigen::Quaterniond(rows).normalized();
  pose.translation = -(pose.rotation * (Eigen::Vector3d(0.0, 0.0, height) + distance * away));
  return pose;
}

}  // namespace helical
