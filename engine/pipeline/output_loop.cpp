#include "engine/pipeline/output_loop.h"

#include <algorithm>

namespace helical {
namespace {

constexpr TimeNs kSilent = 100 * kNanosecondsPerMillisecond;
constexpr TimeNs kHoldNeutral = 400 * kNanosecondsPerMillisecond;
constexpr double kRampDown = 0.5;  // of the throttle that was flown, per second

}  // namespace

void OutputLoop::submit(const StickDemand& demand, TimeNs now) {
  newest_.back() = {demand, now};
  newest_.publish();
}

StickDemand OutputLoop::neutralRamp(TimeNs silent_for) const {
  StickDemand demand = newest_.front().demand;
  const double ramp = kRampDown * std::max(0.0, toSeconds(silent_for - kSilent - kHoldNeutral));
  const double keep = std::max(0.0, 1.0 - ramp);
  return {keep * demand.upper_rotor, keep * demand.lower_rotor, 0.0, 0.0};
}

void OutputLoop::step(TimeNs now) {
  if (stopped()) {
    transmitter_.send({}, now);
    return;
  }
  newest_.take();
  const Stamped& newest = newest_.front();
  const TimeNs silent_for = now - newest.time;
  if (silent_for <= kSilent) {
    transmitter_.send(newest.demand, now);
    return;
  }
  const StickDemand demand = neutralRamp(silent_for);
  // Rotors that were spun down stay off, whatever the flight thread says when it wakes up.
  const bool turned = newest.demand.upper_rotor > 0.0 || newest.demand.lower_rotor > 0.0;
  if (turned && demand.upper_rotor <= 0.0 && demand.lower_rotor <= 0.0)
    gave_up_.store(true, std::memory_order_release);
  transmitter_.send(demand, now);
}

}  // namespace helical
