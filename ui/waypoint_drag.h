#pragma once

#include <Eigen/Core>
#include <QPointF>
#include <QSizeF>
#include <optional>
#include <vector>

namespace helical {

/// Where points of the world are in a picture of the 3D scene, and back. A plain value.
struct SceneProjection {
  Eigen::Matrix4d clip_from_world = Eigen::Matrix4d::Identity();  ///< y up, as OpenGL has it
  QSizeF size{1.0, 1.0};

  /// Nothing for what is behind the eye.
  std::optional<QPointF> toWidget(const Eigen::Vector3d& point) const;
  struct Ray {
    Eigen::Vector3d origin;
    Eigen::Vector3d direction;  ///< of length 1
  };
  Ray through(const QPointF& position) const;
};

/// Takes hold of waypoints in the 3D scene and moves them: over the ground at their height, or up and down
/// above their place. Positions are of the world [m].
class WaypointDrag {
 public:
  static constexpr double kReach = 14.0;  ///< px that a press may miss

  /// The waypoint under `position`; -1 for none.
  static int at(const QPointF& position, const std::vector<Eigen::Vector3d>& plan,
                const SceneProjection& projection);
  /// Where the waypoint goes that is at `waypoint` when the mouse goes to `position`. Nothing where the mouse
  /// points past the horizon.
  static std::optional<Eigen::Vector3d> moved(const Eigen::Vector3d& waypoint, const QPointF& position,
                                              const SceneProjection& projection, bool vertically);
};

}  // namespace helical
