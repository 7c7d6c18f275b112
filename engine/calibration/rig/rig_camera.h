#pragma once

#include <optional>
#include <string>

#include "engine/geometry/camera_model.h"
#include "engine/geometry/rigid_transform.h"

namespace helical {

/// A camera as a rig calibration gets it: what users call it, its intrinsics, and its pose if that is given.
struct RigCamera {
  std::string label;
  CameraModel model;
  std::optional<RigidTransform> camera_from_world;
};

}  // namespace helical
