#include "app/transmitter_check.h"

#include <optional>

#include "engine/transmitter/direction_check.h"

namespace helical {
namespace {

/// Whether the stick goes the right way; nothing when the operator gives up.
std::optional<bool> look(Conversation& talk, const TransmitterOptions& transmitter, const DirectionStep& step) {
  HeldSticks sticks(transmitter);
  return talk.askYes(step.question, [&] { sticks.hold(step.demand); });
}

}  // namespace

bool lookAtDirections(Conversation& talk, TransmitterOptions& transmitter) {
  const auto off = talk.askYes("Are the motors off: their battery out, or disconnected?");
  if (!off || !*off) return false;
  for (int i = 0; i < transmitter.channels.count;) {
    OutputChannel& channel = transmitter.channels.all[static_cast<std::size_t>(i)];
    const auto right = look(talk, transmitter, directionStep(channel.axis));
    if (!right) return false;
    if (*right) {
      ++i;
      continue;
    }
    if (isThrottle(channel.axis)) {
      Conversation::say(
          "calibrate it anew; a throttle that goes the wrong way is turned round in the transmitter "
          "itself\n");
      return false;
    }
    const auto turn = talk.askYes("Does it go the other way? Then it is turned round here, and you look again.");
    if (!turn || !*turn) return false;
    channel.reverse = !channel.reverse;
  }
  return true;
}

}  // namespace helical
