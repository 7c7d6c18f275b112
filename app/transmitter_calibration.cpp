#include "app/transmitter_calibration.h"

#include <cmath>
#include <string>

#include "engine/transmitter/channel_measurement.h"

namespace helical {
namespace {

/// Three voltages that the operator has found.
std::optional<OutputChannel> measureChannel(Conversation& talk, OutputProbe& probe, StickAxis axis, int usual_output) {
  const std::string name = toString(axis);
  int output = 0;
  for (;;) {
    const auto answer = talk.askNumber("\n" + name + ": output", usual_output, [](double) {});
    if (!answer) return std::nullopt;
    output = static_cast<int>(*answer);
    if (*answer >= 0.0 && output < probe.count() && *answer == std::floor(*answer)) break;
    Conversation::say("  the device has outputs 0 to " + std::to_string(probe.count() - 1) + "\n");
  }
  probe.choose(output, axis);
  const auto put = [&](double volts) {
    if (!probe.put(volts)) Conversation::say("  it goes from -10 to 10 V, a throttle from 0\n");
  };
  const StickEnds words = endsOf(axis);
  const bool throttle = isThrottle(axis);
  MeasuredEnds ends = usualEnds(axis);
  const auto ask = [&](double& volts, const std::string& what) {
    const auto found = talk.askNumber(name + ", volts " + what, volts, put);
    volts = found.value_or(volts);
    return found.has_value();
  };
  if (!ask(ends.low, words.low) || !ask(ends.neutral, throttle ? "at half" : "at neutral") ||
      !ask(ends.high, words.high))
    return std::nullopt;
  probe.put(throttle ? ends.low : ends.neutral);
  const auto slew = talk.askNumber(name + ", fastest change in volts a second, 0 for any", 0.0, [](double) {});
  if (!slew) return std::nullopt;
  return channelOf(axis, output, ends, *slew);
}

std::optional<OutputChannels> measureVoltages(Conversation& talk, const std::string& serial) {
  OutputProbe probe(serial);
  Conversation::say(
      "Motors off: take their battery out, or disconnect them. Each question tries the voltage that is in brackets;\n"
      "another number tries that one, an empty line takes it. Ctrl-C gives up.\n");
  const auto mixed = talk.askYes(
      "Does the transmitter have one channel for throttle and one for yaw (not one for each rotor)?");
  if (!mixed) return std::nullopt;
  OutputChannels channels;
  for (const StickAxis axis : axesOf(*mixed)) {
    const auto channel = measureChannel(talk, probe, axis, channels.count);
    if (!channel) return std::nullopt;
    channels.all[static_cast<std::size_t>(channels.count++)] = *channel;
  }
  return channels;
}

std::optional<OutputChannels> askForLimits(Conversation& talk) {
  FullDeflection full;
  const auto ask = [&](double& value, const char* what) {
    const auto answer = talk.askNumber(what, value, [](double) {});
    value = answer.value_or(value);
    return answer.has_value();
  };
  if (!ask(full.thrust, "full throttle, up to 60000") || !ask(full.yaw_deg_s, "full yaw, degrees a second") ||
      !ask(full.tilt_deg, "full roll and pitch, degrees"))
    return std::nullopt;
  return channelsOf(full);
}

}  // namespace

std::optional<OutputChannels> measureChannels(Conversation& talk, const TransmitterOptions& transmitter) {
  auto channels = takesVoltages(transmitter) ? measureVoltages(talk, transmitter.device) : askForLimits(talk);
  if (!channels) return std::nullopt;
  TransmitterOptions measured = transmitter;
  measured.channels = *channels;
  validate(measured);
  return channels;
}

}  // namespace helical
