#pragma once

#include <Eigen/Core>

namespace helical {

/// Light that comes back along a ray: blue, green, red in grey levels, before noise.
struct SceneColour {
  Eigen::Vector3f bgr = Eigen::Vector3f::Zero();
  bool is_floor = false;
};

/// The direction, in the world, in which the room's lamp stands: what shades the helicopter and throws its
/// shadow.
Eigen::Vector3d lampDirection();

/// The room of the simulated rig as seen along a ray in the world frame: wooden floor, landing pad at the
/// origin, walls, some furniture; muted colours, none of them a marker's. Any thread.
SceneColour roomColour(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction);

}  // namespace helical
