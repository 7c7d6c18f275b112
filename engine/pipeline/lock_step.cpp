#include "engine/pipeline/lock_step.h"

#include "engine/base/error.h"
#include "engine/pipeline/rig_devices.h"

namespace helical {
namespace {

constexpr TimeNs kStep = kNanosecondsPerMillisecond;

const RigConfig& simulatedOnly(const RigConfig& rig) {
  if (needsRealTime(rig))
    throw Error(ErrorKind::kInput, "this rig's cameras or transmitter live in real time", rig.path,
                "fly it with --realtime");
  return rig;
}

}  // namespace

LockStep::LockStep(const RigConfig& rig, const FlightPlan& plan, FlightTap* tap)
    : clock_(std::make_shared<ManualClock>()),
      hardware_(openRig(simulatedOnly(rig), clock_)),
      loop_(rig, plan),
      output_(*hardware_.transmitter),
      tap_(tap),
      announcer_(rig),
      tick_period_s_(1.0 / rig.control.rate_hz) {}

const EngineSnapshot& LockStep::tick(const OperatorCommands& commands) {
  const TimeNs tick_time = fromSeconds(tick_period_s_ * static_cast<double>(++ticks_));
  while (clock_->now() < tick_time) {
    clock_->set(clock_->now() + kStep);
    Observation observation;
    for (auto& source : hardware_.sources)
      while (source->poll(observation)) use(observation);
  }
  const TimeNs now = clock_->now();
  if (commands.kill) output_.kill();
  OperatorCommands gated = commands;
  gated.kill = output_.stopped();
  output_.submit(loop_.onTick(now, gated), now);
  output_.step(now);
  snapshot_ = loop_.snapshot();
  hardware_.addTruth(snapshot_, now);
  if (tap_ != nullptr) {
    tap_->onTick(gated, snapshot_);
    announcer_.announce(snapshot_, output_.gaveUp(),
                        [this](const EngineEvent& event) { tap_->onEvent(event); });
  }
  return snapshot_;
}

void LockStep::use(const Observation& observation) {
  const TimeNs now = clock_->now();
  loop_.onObservation(observation, now);
  const auto camera = static_cast<std::size_t>(observation.camera.index());
  if (tap_ != nullptr) tap_->onObservation(observation, now, loop_.snapshot().cameras[camera].track);
}

void LockStep::hideCamera(CameraId camera, bool hidden) {
  loop_.hideCamera(camera, hidden);
  if (tap_ != nullptr) tap_->onHidden(camera, hidden, clock_->now());
}

}  // namespace helical
