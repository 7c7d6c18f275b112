#pragma once

#include <Eigen/Core>

#include "engine/geometry/rigid_transform.h"

namespace helical {

/// Rigid-body state of the helicopter. Body: x forward, y left, z up, origin at the centre of mass; SI units.
struct HelicopterState {
  RigidTransform world_from_body;
  Eigen::Vector3d velocity_in_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_velocity_in_body = Eigen::Vector3d::Zero();
};

}  // namespace helical
