#include "engine/geometry/rotation.h"

#include <algorithm>
#include <cmath>

namespace helical {

Eigen::Matrix3d hat(const Eigen::Vector3d& a) {
  Eigen::Matrix3d m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

Eigen::Quaterniond expSO3(const Eigen::Vector3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  // sin(angle/2)/angle by its series where the quotient loses digits.
  const double scale = angle < 1e-4 ? 0.5 - angle * angle / 48.0 : std::sin(0.5 * angle) / angle;
  Eigen::Quaterniond q;
  q.w() = std::cos(0.5 * angle);
  q.vec() = scale * rotation_vector;
  return q;
}

Eigen::Vector3d logSO3(const Eigen::Quaterniond& q) {
  // q and -q are one rotation; the one with w >= 0 has the angle at most pi.
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;
  const Eigen::Vector3d v = sign * q.vec();
  const double w = sign * q.w();
  const double s = v.norm();
  const double scale = s < 1e-8 ? 2.0 / std::max(w, 1e-12) : 2.0 * std::atan2(s, w) / s;
  return scale * v;
}

Eigen::Matrix3d rightJacobianSO3(const Eigen::Vector3d& a) {
  const double angle = a.norm();
  const Eigen::Matrix3d k = hat(a);
  if (angle < 1e-4) return Eigen::Matrix3d::Identity() - 0.5 * k + k * k / 6.0;
  const double angle2 = angle * angle;
  return Eigen::Matrix3d::Identity() - (1.0 - std::cos(angle)) / angle2 * k +
         (angle - std::sin(angle)) / (angle2 * angle) * k * k;
}

double yawOf(const Eigen::Quaterniond& q) {
  return std::atan2(2.0 * (q.w() * q.z() + q.x() * q.y()), 1.0 - 2.0 * (q.y() * q.y() + q.z() * q.z()));
}

double tiltOf(const Eigen::Quaterniond& q) {
  return std::acos(std::clamp(1.0 - 2.0 * (q.x() * q.x() + q.y() * q.y()), -1.0, 1.0));
}

double wrapAngle(double angle) {
  return angle - 2.0 * kPi * std::floor((angle + kPi) / (2.0 * kPi));
}

}  // namespace helical
