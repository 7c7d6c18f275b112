#include "engine/simulator/simulated_camera.h"

#include <algorithm>

#include "engine/simulator/random_streams.h"

namespace helical {
SimulatedCamera::SimulatedCamera(CameraId camera, const CameraModel& model,
                                 const RigidTransform& camera_from_world, const MarkerLayout& markers,
                                 int background_frames, const SimulationOptions& options,
                                 std::shared_ptr<World> world, std::shared_ptr<Clock> clock)
    : camera_(camera),
      world_(std::move(world)),
      clock_(std::move(clock)),
      exposures_(options, randomStream(options.seed, RandomStream::kExposures, camera)),
      view_(camera, model, camera_from_world, markers, options),
      background_frames_(background_frames) {
  if (background_frames_ > 0) world_->holdEmpty();
}

void SimulatedCamera::expose(TimeNs now) {
  world_->advanceTo(now);
  image_ = view_.render(*world_, exposures_.exposure());
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
  frame = {camera_, exposures_.sequence(), exposures_.exposure(), exposures_.arrival(), image_, 0, 0};
  exposures_.next();
  exposed_ = false;
  if (background_frames_ > 0 && --background_frames_ == 0) world_->releaseEmpty();
  return true;
}

}  // namespace helical
