#include "app/transmitter_check.h"

#include <chrono>
#include <optional>
#include <string>
#include <thread>

#include "engine/base/error.h"
#include "engine/transmitter/output_process.h"

namespace helical {
namespace {

constexpr double kMoved = 0.5;      // of a stick's way
constexpr double kThrottled = 0.3;  // likewise
constexpr int kPatience = 300;      // times 10 ms for the output process and its device

struct Step {
  StickAxis axis;
  StickDemand demand;
  const char* question;
};

Step stepOf(StickAxis axis) {
  switch (axis) {
    case StickAxis::kRoll:
      return {axis, {0.0, 0.0, kMoved, 0.0}, "roll: is the swash plate tipped to the right now?"};
    case StickAxis::kPitch:
      return {axis, {0.0, 0.0, 0.0, kMoved}, "pitch: is the swash plate tipped forward now?"};
    case StickAxis::kYaw:
      return {axis, {0.0, kMoved, 0.0, 0.0}, "yaw: does the transmitter show yaw to the left now?"};
    case StickAxis::kUpperRotor:
      return {axis, {kThrottled, 0.0, 0.0, 0.0}, "upper rotor: does the transmitter show about a third for it, and no other?"};
    case StickAxis::kLowerRotor:
      return {axis, {0.0, kThrottled, 0.0, 0.0}, "lower rotor: does the transmitter show about a third for it, and no other?"};
    case StickAxis::kThrottle:
      return {axis, {kThrottled, kThrottled, 0.0, 0.0}, "throttle: does the transmitter show about a third now?"};
  }
  return {axis, {}, ""};
}

/// Sticks that stay where they were put, through the output process as in flight.
class Sticks {
 public:
  explicit Sticks(const TransmitterOptions& options) : output_(outputSettings(options), OutputProcess::findProgram()) {
    for (int i = 0; i < kPatience; ++i) {
      output_.send({}, 0);
      if (output_.report().sequence > 0 && !output_.report().locked && output_.status().present) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    lose();
  }
  void send(const StickDemand& demand) {
    output_.send(demand, 0);
    if (!output_.status().present) lose();
  }

 private:
  [[noreturn]] void lose() const {
    const TransmitterTrouble trouble = output_.status().trouble == TransmitterTrouble::kNone ? TransmitterTrouble::kAbsent
                                                                                             : output_.status().trouble;
    throw Error(ErrorKind::kDevice, toString(trouble), {}, cureOf(trouble));
  }
  OutputProcess output_;
};

/// Whether the stick goes the right way; nothing when the operator gives up.
std::optional<bool> look(Conversation& talk, const TransmitterOptions& transmitter, const Step& step) {
  Sticks sticks(transmitter);
  return talk.askYes(step.question, [&] { sticks.send(step.demand); });
}

}  // namespace

bool lookAtDirections(Conversation& talk, TransmitterOptions& transmitter) {
  const auto off = talk.askYes("Are the motors off: their battery out, or disconnected?");
  if (!off || !*off) return false;
  for (int i = 0; i < transmitter.channels.count;) {
    OutputChannel& channel = transmitter.channels.all[static_cast<std::size_t>(i)];
    const auto right = look(talk, transmitter, stepOf(channel.axis));
    if (!right) return false;
    if (*right) {
      ++i;
      continue;
    }
    if (isThrottle(channel.axis)) {
      Conversation::say("calibrate it anew; a throttle that goes the wrong way is turned round in the transmitter itself\n");
      return false;
    }
    const auto turn = talk.askYes("Does it go the other way? Then it is turned round here, and you look again.");
    if (!turn || !*turn) return false;
    channel.reverse = !channel.reverse;
  }
  return true;
}

}  // namespace helical
