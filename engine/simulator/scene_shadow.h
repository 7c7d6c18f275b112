#pragma once

#include <cstdint>

#include "engine/geometry/camera_model.h"
#include "engine/geometry/rigid_transform.h"
#include "engine/simulator/scene_background.h"

namespace helical {

/// Darkens the floor where the helicopter keeps the lamp's light away: softer and fainter the higher it
/// flies. `bgr` are packed rows of the camera's size.
void castShadow(const CameraModel& model, const RigidTransform& camera_from_world,
                const RigidTransform& world_from_body, const SceneBackground& background, std::uint8_t* bgr);

}  // namespace helical
