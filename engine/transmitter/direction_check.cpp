#include "engine/transmitter/direction_check.h"

#include "engine/base/error.h"
#include "engine/base/monotonic.h"

namespace helical {
namespace {

constexpr double kMoved = 0.5;      // of a stick's way
constexpr double kThrottled = 0.3;  // likewise
constexpr int kPatience = 300;
constexpr TimeNs kPause = 10 * kNanosecondsPerMillisecond;

}  // namespace

DirectionStep directionStep(StickAxis axis) {
  switch (axis) {
    case StickAxis::kRoll:
      return {axis, {0.0, 0.0, kMoved, 0.0}, "roll: is the swash plate tipped to the right now?"};
    case StickAxis::kPitch:
      return {axis, {0.0, 0.0, 0.0, kMoved}, "pitch: is the swash plate tipped forward now?"};
    case StickAxis::kYaw:
      return {axis, {0.0, kMoved, 0.0, 0.0}, "yaw: does the transmitter show yaw to the left now?"};
    case StickAxis::kUpperRotor:
      return {axis,
              {kThrottled, 0.0, 0.0, 0.0},
              "upper rotor: does the transmitter show about a third for it, and no other?"};
    case StickAxis::kLowerRotor:
      return {axis,
              {0.0, kThrottled, 0.0, 0.0},
              "lower rotor: does the transmitter show about a third for it, and no other?"};
    case StickAxis::kThrottle:
      break;
  }
  return {axis, {kThrottled, kThrottled, 0.0, 0.0}, "throttle: does the transmitter show about a third now?"};
}

HeldSticks::HeldSticks(const TransmitterOptions& options)
    : output_(outputSettings(options), OutputProcess::findProgram()) {
  for (int i = 0; i < kPatience; ++i) {
    output_.send({}, 0);
    if (output_.report().sequence > 0 && !output_.report().locked && output_.status().present) return;
    sleepUntilMonotonic(monotonicNow() + kPause);
  }
  lose();
}

void HeldSticks::hold(const StickDemand& demand) {
  output_.send(demand, 0);
  if (!output_.status().present) lose();
}

void HeldSticks::lose() const {
  const TransmitterTrouble told = output_.status().trouble;
  const TransmitterTrouble trouble = told == TransmitterTrouble::kNone ? TransmitterTrouble::kAbsent : told;
  throw Error(ErrorKind::kDevice, toString(trouble), {}, cureOf(trouble));
}

}  // namespace helical
