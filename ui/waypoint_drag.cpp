#include "ui/waypoint_drag.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

namespace helical {
namespace {

constexpr double kFarthest = 20.0;  // m, from the eye: a drag to the horizon is no drag to infinity

}  // namespace

std::optional<QPointF> SceneProjection::toWidget(const Eigen::Vector3d& point) const {
  const Eigen::Vector4d clip = clip_from_world * point.homogeneous();
  if (clip.w() <= 0.0) return std::nullopt;
  return QPointF(0.5 * (1.0 + clip.x() / clip.w()) * size.width(),
                 0.5 * (1.0 - clip.y() / clip.w()) * size.height());
}

SceneProjection::Ray SceneProjection::through(const QPointF& position) const {
  const Eigen::Matrix4d world_from_clip = clip_from_world.inverse();
  const double x = 2.0 * position.x() / size.width() - 1.0, y = 1.0 - 2.0 * position.y() / size.height();
  const Eigen::Vector3d near = (world_from_clip * Eigen::Vector4d(x, y, -1.0, 1.0)).hnormalized();
  const Eigen::Vector3d far = (world_from_clip * Eigen::Vector4d(x, y, 0.5, 1.0)).hnormalized();
  return {near, (far - near).normalized()};
}

int WaypointDrag::at(const QPointF& position, const std::vector<Eigen::Vector3d>& plan,
                     const SceneProjection& projection) {
  int best = -1;
  double nearest = kReach;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const auto seen = projection.toWidget(plan[i]);
    if (!seen) continue;
    const double distance = std::hypot(seen->x() - position.x(), seen->y() - position.y());
    if (distance >= nearest) continue;
    nearest = distance;
    best = static_cast<int>(i);
  }
  return best;
}

std::optional<Eigen::Vector3d> WaypointDrag::moved(const Eigen::Vector3d& waypoint, const QPointF& position,
                                                   const SceneProjection& projection, bool vertically) {
  const SceneProjection::Ray ray = projection.through(position);
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  if (vertically) {
    // Upright, and as square to the eye as that allows.
    normal = Eigen::Vector3d(ray.direction.x(), ray.direction.y(), 0.0);
    if (normal.norm() < 0.05) return std::nullopt;
    normal.normalize();
  }
  const double towards = normal.dot(ray.direction);
  if (std::abs(towards) < 0.02) return std::nullopt;
  const double distance = normal.dot(waypoint - ray.origin) / towards;
  if (distance <= 0.0 || distance > kFarthest) return std::nullopt;
  const Eigen::Vector3d hit = ray.origin + distance * ray.direction;
  if (vertically) return Eigen::Vector3d(waypoint.x(), waypoint.y(), hit.z());
  return hit;
}

}  // namespace helical
