#include "engine/pipeline/lock_step.h"

namespace helical {
namespace {

constexpr TimeNs kStep = kNanosecondsPerMillisecond;

}  // namespace

LockStep::LockStep(const RigConfig& rig, const FlightPlan& plan)
    : clock_(std::make_shared<ManualClock>()),
      hardware_(openRig(rig, clock_)),
      loop_(rig, plan),
      output_(*hardware_.transmitter),
      tick_period_s_(1.0 / rig.control.rate_hz) {}

const EngineSnapshot& LockStep::tick(const OperatorCommands& commands) {
  const TimeNs tick_time = fromSeconds(tick_period_s_ * static_cast<double>(++ticks_));
  while (clock_->now() < tick_time) {
    clock_->set(clock_->now() + kStep);
    Observation observation;
    for (auto& source : hardware_.sources)
      while (source->poll(observation)) loop_.onObservation(observation, clock_->now());
  }
  const TimeNs now = clock_->now();
  if (commands.kill) output_.kill();
  OperatorCommands gated = commands;
  gated.kill = output_.stopped();
  output_.submit(loop_.onTick(now, gated), now);
  output_.step(now);
  snapshot_ = loop_.snapshot();
  hardware_.addTruth(snapshot_, now);
  return snapshot_;
}

}  // namespace helical
