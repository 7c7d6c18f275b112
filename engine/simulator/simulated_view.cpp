#include "engine/simulator/simulated_view.h"

#include "engine/simulator/random_streams.h"

namespace helical {
namespace {

SceneOptions sceneOptions(CameraId camera, const SimulationOptions& options) {
  Random random = randomStream(options.seed, RandomStream::kImages, camera);
  return {random.bits(), options.image_noise, options.light_drift};
}

}  // namespace

SimulatedView::SimulatedView(CameraId camera, const CameraModel& model, const RigidTransform& camera_from_world,
                             const MarkerLayout& markers, const SimulationOptions& options)
    : camera_(camera),
      disturbances_(camera, options, camera_from_world, randomStream(options.seed, RandomStream::kKnocks, camera)),
      renderer_(model, markers, sceneOptions(camera, options)) {
  // Draws the room now: the first frame must not be late.
  renderer_.render(disturbances_.cameraFromWorld(0.0), std::nullopt, 0.0);
}

ImageView SimulatedView::render(const World& world, TimeNs exposure) {
  const double time_s = toSeconds(exposure);
  std::optional<HelicopterView> view;
  if (const auto sample = world.at(exposure))
    view =
        HelicopterView{sample->state.world_from_body, sample->upper_rotor_angle, sample->lower_rotor_angle};
  const RigidTransform camera_from_world = world.knocked(camera_, disturbances_.cameraFromWorld(time_s));
  return renderer_.render(camera_from_world, view, time_s, disturbances_.boardCover(time_s));
}

}  // namespace helical
