#pragma once

#include <memory>

#include "engine/simulator/disturbances.h"
#include "engine/simulator/scene_renderer.h"
#include "engine/simulator/world.h"

namespace helical {

/// What one simulated camera has before its lens: the world as it truly is, seen from where the camera truly is.
/// One thread.
class SimulatedView {
 public:
  SimulatedView(CameraId camera, const CameraModel& model, const RigidTransform& camera_from_world,
                const MarkerLayout& markers, const SimulationOptions& options);

  /// Picture at `exposure`, a time of the world's, which must have been advanced that far. Valid until the next call.
  ImageView render(const World& world, TimeNs exposure);

 private:
  CameraId camera_;
  CameraDisturbances disturbances_;
  SceneRenderer renderer_;
};

}  // namespace helical
