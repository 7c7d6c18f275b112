#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace helical {

/// Cross-product matrix: hat(a) b = a x b.
Eigen::Matrix3d hat(const Eigen::Vector3d& a);

/// Exponential map of SO(3) (Rodrigues' formula): the rotation about `rotation_vector` by its norm [rad].
Eigen::Quaterniond expSO3(const Eigen::Vector3d& rotation_vector);

/// Logarithm of SO(3): the rotation vector of `q`, of norm at most pi.
Eigen::Vector3d logSO3(const Eigen::Quaterniond& q);

/// Right Jacobian of SO(3): exp(a + d) = exp(a) exp(Jr(a) d) to first order in d.
Eigen::Matrix3d rightJacobianSO3(const Eigen::Vector3d& a);

/// Heading of the body's x axis in the world's x-y plane [rad], in (-pi, pi].
double yawOf(const Eigen::Quaterniond& world_from_body);

/// Angle between the body's z axis and the world's [rad].
double tiltOf(const Eigen::Quaterniond& world_from_body);

/// The same angle in [-pi, pi).
double wrapAngle(double angle);

constexpr double kPi = 3.14159265358979323846;
constexpr double toRadians(double degrees) {
  return degrees * (kPi / 180.0);
}
constexpr double toDegrees(double radians) {
  return radians * (180.0 / kPi);
}

}  // namespace helical
