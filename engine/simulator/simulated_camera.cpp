#include "engine/simulator/simulated_camera.h"

#include <algorithm>

#include "engine/simulator/random_streams.h"

namespace helical {
namespace {

SceneOptions sceneOptions(CameraId camera, const SimulationOptions& options) {
  Random random = randomStream(options.seed, RandomStream::kImages, camera);
  return {random.bits(), options.image_noise, options.light_drift};
}

}  // namespace

SimulatedCamera::SimulatedCamera(CameraId camera, const CameraModel& model,
                                 const RigidTransform& camera_from_world, const MarkerLayout& markers,
                                 int background_frames, const SimulationOptions& options,
                                 std::shared_ptr<World> world, std::shared_ptr<Clock> clock)
    : camera_(camera),
      world_(std::move(world)),
      clock_(std::move(clock)),
      disturbances_(camera, options, camera_from_world,
                    randomStream(options.seed, RandomStream::kKnocks, camera)),
      exposures_(options, randomStream(options.seed, RandomStream::kExposures, camera)),
      renderer_(model, markers, sceneOptions(camera, options)),
      background_frames_(background_frames) {
  if (background_frames_ > 0) world_->holdEmpty();
  // Draws the room now: the first frame must not be late.
  renderer_.render(disturbances_.cameraFromWorld(0.0), std::nullopt, 0.0);
}

void SimulatedCamera::expose(TimeNs now) {
  world_->advanceTo(now);
  const double time_s = toSeconds(exposures_.exposure());
  std::optional<HelicopterView> view;
  if (const auto sample = world_->at(exposures_.exposure()))
    view =
        HelicopterView{sample->state.world_from_body, sample->upper_rotor_angle, sample->lower_rotor_angle};
  const RigidTransform camera_from_world = world_->knocked(camera_, disturbances_.cameraFromWorld(time_s));
  image_ = renderer_.render(camera_from_world, view, time_s, disturbances_.boardCover(time_s));
  exposed_ = true;
}

void SimulatedCamera::wait(TimeNs deadline) {
  // Draws during the read-out, so that the frame is there when it arrives.
  if (!exposed_) {
    clock_->sleepUntil(std::min(deadline, exposures_.exposure()));
    const TimeNs now = clock_->now();
    if (now >= exposures_.exposure()) {
      exposures_.skipLost(now);
      if (now >= exposures_.exposure()) expose(now);
    }
  }
  clock_->sleepUntil(std::min(deadline, exposures_.arrival()));
}

bool SimulatedCamera::poll(Frame& frame) {
  const TimeNs now = clock_->now();
  if (!exposed_) exposures_.skipLost(now);
  if (now < exposures_.arrival()) return false;
  if (!exposed_) expose(now);
  frame = {camera_, exposures_.sequence(), exposures_.exposure(), exposures_.arrival(), image_};
  exposures_.next();
  exposed_ = false;
  if (background_frames_ > 0 && --background_frames_ == 0) world_->releaseEmpty();
  return true;
}

}  // namespace helical
