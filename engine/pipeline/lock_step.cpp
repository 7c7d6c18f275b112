#include "engine/pipeline/lock_step.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/pipeline/calibration_view.h"
#include "engine/pipeline/rig_devices.h"

namespace helical {
namespace {

constexpr TimeNs kStep = kNanosecondsPerMillisecond;
constexpr double kMoved = 1e-6;  // m and rad, by more than a pose loses on its way through a file

const RigConfig& simulatedOnly(const RigConfig& rig) {
  if (needsRealTime(rig))
    throw Error(ErrorKind::kInput, "this rig's cameras or transmitter live in real time", rig.path,
                "fly it with --realtime");
  return rig;
}

}  // namespace

LockStep::LockStep(const RigConfig& rig, const FlightPlan& plan, FlightTap* tap)
    : rig_(rig),
      clock_(std::make_shared<ManualClock>()),
      hardware_(openRig(simulatedOnly(rig), clock_,
                        [tap](const Frame& frame, const Observation& observation, const Extractor&) {
                          if (tap != nullptr) tap->onFrame(frame, observation);
                        },
                        plan.carried_s)),
      loop_(rig, plan),
      output_(*hardware_.transmitter),
      tap_(tap),
      announcer_(rig),
      tick_period_s_(1.0 / rig.control.rate_hz) {}

void LockStep::passTo(TimeNs time, bool looking) {
  while (clock_->now() < time) {
    // On the grid of milliseconds; only a recorded tick may lie between two of its points.
    const TimeNs next = (clock_->now() / kStep + 1) * kStep;
    clock_->set(looking ? next : std::min(next, time));
    Observation observation;
    for (auto& source : hardware_.sources)
      while (source->poll(observation))
        if (looking) use(observation);
  }
}

const EngineSnapshot& LockStep::tick(const OperatorCommands& commands) {
  passTo(counted_from_ + fromSeconds(tick_period_s_ * static_cast<double>(++ticks_)), true);
  if (commands.kill) output_.kill();
  OperatorCommands gated = commands;
  gated.kill = output_.stopped();
  DeviceStatus devices;
  devices.transmitter = output_.transmitterStatus();
  if (tap_ != nullptr) devices.record = tap_->health();
  const EngineSnapshot& state = command(clock_->now(), gated, devices);
  if (tap_ != nullptr) show(gated, state.time);
  return state;
}

const EngineSnapshot& LockStep::follow(const RecordedTick& recorded) {
  passTo(recorded.time, false);
  counted_from_ = recorded.time;
  ticks_ = 0;
  if (recorded.commands.kill) output_.kill();
  setRight(recorded);
  return command(recorded.time, recorded.commands, recorded.devices);
}

void LockStep::setRight(const RecordedTick& recorded) {
  World& world = *hardware_.world;
  world.advanceTo(recorded.time);
  if (recorded.truth) world.setRight(*recorded.truth, recorded.time);
  for (std::size_t i = 0; i < hardware_.disturbances.size(); ++i) {
    const auto& truth = recorded.true_camera_from_world[i];
    if (!hardware_.disturbances[i] || !truth) continue;
    const RigidTransform planned = hardware_.disturbances[i]->cameraFromWorld(toSeconds(recorded.time));
    // Only where somebody moved it: any other one is where the rig file says, to the last bit.
    if ((truth->translation - planned.translation).norm() > kMoved ||
        truth->rotation.angularDistance(planned.rotation) > kMoved)
      world.setRight(cameraId(static_cast<int>(i)), planned, *truth);
  }
}

const EngineSnapshot& LockStep::command(TimeNs now, const OperatorCommands& commands,
                                        const DeviceStatus& devices) {
  output_.submit(loop_.onTick(now, commands, devices), now);
  for (std::size_t i = 0; i < hardware_.orders.size(); ++i)
    hardware_.orders[i]->expect(loop_.expectedBalls(cameraId(static_cast<int>(i))));
  output_.step(now);
  snapshot_ = loop_.snapshot();
  hardware_.addTruth(snapshot_, now);
  hardware_.addLinks(snapshot_);
  return snapshot_;
}

void LockStep::show(const OperatorCommands& commands, TimeNs now) {
  for (int i = 0; snapshot_.tick % kCalibrationViewTicks == 0 && i < snapshot_.camera_count; ++i) {
    const CameraCalibration* calibration = loop_.calibration(cameraId(i));
    if (calibration == nullptr) continue;
    fillView(*calibration, belief_);
    tap_->onBelief(cameraId(i), belief_, now);
  }
  tap_->onTick(commands, snapshot_);
  announcer_.announce(snapshot_, output_.gaveUp(),
                      [this](const EngineEvent& event) { tap_->onEvent(event); });
}

void LockStep::use(const Observation& observation) {
  const TimeNs now = clock_->now();
  loop_.onObservation(observation, now);
  if (tap_ != nullptr) tap_->onObservation(observation, now, loop_.lastTrack());
}

void LockStep::change(const FlightChange& change) {
  validate(change);
  FlightChange applied = change;
  if (applied.plan) loop_.swapPlan(*applied.plan);
  if (applied.control) loop_.setControl(*applied.control);
  if (tap_ != nullptr) tap_->onChange(std::make_shared<const FlightChange>(change), clock_->now());
}

void LockStep::hideCamera(CameraId camera, bool hidden) {
  loop_.hideCamera(camera, hidden);
  if (tap_ != nullptr) tap_->onHidden(camera, hidden, clock_->now());
}

void LockStep::calibrate(CameraId id, const std::string& method, std::uint64_t seed) {
  auto calibration = newCalibration(rig_, id, method, seed);
  const char* name = calibration->calibrator().name();
  loop_.swapCalibration(id, calibration);
  if (tap_ != nullptr) tap_->onCalibration(id, name, seed, clock_->now());
}

const char* LockStep::orderCalibration(const CalibrationOrder& order) {
  const char* refusal = loop_.orderCalibration(order);
  if (tap_ != nullptr) tap_->onCalibrationOrder(order, clock_->now());
  return refusal;
}

}  // namespace helical
