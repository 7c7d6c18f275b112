#include "engine/transmitter/output_channel.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include "engine/base/error.h"

namespace helical {
namespace {

double targetOf(const OutputChannel& channel, const StickDemand& demand) {
  const double neutral = channel.neutral + channel.trim;
  const double value = valueOf(channel.axis, demand);
  // -1 .. 1, whatever the axis.
  const double stick = isThrottle(channel.axis) ? 2.0 * value - 1.0 : channel.reverse ? -value : value;
  return stick < 0.0 ? neutral + stick * (neutral - channel.minimum) : neutral + stick * (channel.maximum - neutral);
}

[[noreturn]] void refuse(const OutputChannel& channel, const std::string& what, const std::string& cure) {
  throw Error(ErrorKind::kInput, std::string("channel '") + toString(channel.axis) + "': " + what, {}, cure);
}

void validateChannel(const OutputChannel& c, const ChannelLimits& limits) {
  for (const double value : {c.minimum, c.neutral, c.maximum, c.trim, c.slew_per_s})
    if (!std::isfinite(value)) refuse(c, "a value is no number", "give numbers");
  if (!(c.minimum < c.neutral + c.trim && c.neutral + c.trim < c.maximum))
    refuse(c, "minimum, neutral with trim, and maximum are not in this order",
           "give the smaller end as minimum; use reverse to turn a stick round");
  const double low = isThrottle(c.axis) ? 0.0 : limits.low;
  const double high = isThrottle(c.axis) ? limits.throttle_high : limits.high;
  if (c.minimum < low || c.maximum > high)
    refuse(c, "it goes beyond what the device gives",
           "keep it from " + std::to_string(low) + " to " + std::to_string(high));
  if (c.reverse && isThrottle(c.axis))
    refuse(c, "it is reversed, so that a device without power would give full throttle",
           "turn the channel round in the transmitter itself");
  if (c.slew_per_s < 0.0) refuse(c, "slew_per_s is negative", "give 0 for none, or the fastest change");
  if (c.output < 0 || c.output > 15) refuse(c, "there is no such output", "outputs count from 0 to 15");
}

int countOf(const OutputChannels& channels, StickAxis axis) {
  const auto all = channels.span();
  return static_cast<int>(std::count_if(all.begin(), all.end(), [&](const auto& c) { return c.axis == axis; }));
}

std::uint64_t mixIn(std::uint64_t hash, std::uint64_t value) {
  // splitmix64's finaliser
  hash += value + 0x9e3779b97f4a7c15U;
  hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9U;
  hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebU;
  return hash ^ (hash >> 31);
}

}  // namespace

const char* toString(StickAxis axis) {
  switch (axis) {
    case StickAxis::kUpperRotor:
      return "upper_rotor";
    case StickAxis::kLowerRotor:
      return "lower_rotor";
    case StickAxis::kThrottle:
      return "throttle";
    case StickAxis::kYaw:
      return "yaw";
    case StickAxis::kRoll:
      return "roll";
    case StickAxis::kPitch:
      return "pitch";
  }
  return "";
}

bool isThrottle(StickAxis axis) {
  return axis == StickAxis::kUpperRotor || axis == StickAxis::kLowerRotor || axis == StickAxis::kThrottle;
}

double valueOf(StickAxis axis, const StickDemand& demand) {
  switch (axis) {
    case StickAxis::kUpperRotor:
      return std::clamp(demand.upper_rotor, 0.0, 1.0);
    case StickAxis::kLowerRotor:
      return std::clamp(demand.lower_rotor, 0.0, 1.0);
    case StickAxis::kThrottle:
      return std::clamp(0.5 * (demand.upper_rotor + demand.lower_rotor), 0.0, 1.0);
    case StickAxis::kYaw:
      return std::clamp(demand.lower_rotor - demand.upper_rotor, -1.0, 1.0);
    case StickAxis::kRoll:
      return std::clamp(demand.roll, -1.0, 1.0);
    case StickAxis::kPitch:
      return std::clamp(demand.pitch, -1.0, 1.0);
  }
  return 0.0;
}

void validate(const OutputChannels& channels, const ChannelLimits& limits) {
  if (channels.count == 0) return;
  for (const OutputChannel& channel : channels.span()) {
    validateChannel(channel, limits);
    for (const OutputChannel& other : channels.span())
      if (&other != &channel && other.output == channel.output)
        refuse(channel, "another channel is on output " + std::to_string(channel.output), "give each an output of its own");
  }
  const auto once = [&](StickAxis axis) { return countOf(channels, axis) == 1; };
  const bool rotors = once(StickAxis::kUpperRotor) && once(StickAxis::kLowerRotor) && limits.mixes_rotors;
  const bool throttle = once(StickAxis::kThrottle) && once(StickAxis::kYaw);
  if (channels.count != 4 || rotors == throttle || !once(StickAxis::kRoll) || !once(StickAxis::kPitch))
    throw Error(ErrorKind::kInput, "the channels do not carry every stick once", {},
                limits.mixes_rotors
                    ? "give roll, pitch and either throttle and yaw or upper_rotor and lower_rotor, each once"
                    : "give roll, pitch, throttle and yaw, each once");
}

std::uint64_t fingerprintOf(const OutputChannels& channels) {
  std::uint64_t hash = 0;
  for (const OutputChannel& c : channels.span()) {
    hash = mixIn(hash, static_cast<std::uint64_t>(c.axis) * 64 + static_cast<std::uint64_t>(c.output) * 2 +
                           (c.reverse ? 1 : 0));
    for (const double value : {c.minimum, c.neutral, c.maximum}) hash = mixIn(hash, std::bit_cast<std::uint64_t>(value));
  }
  return hash;
}

std::span<const double> ChannelMapper::step(const StickDemand& demand, TimeNs now) {
  const bool first = last_ < 0;
  const double passed = first ? 0.0 : std::max(0.0, toSeconds(now - last_));
  last_ = now;
  for (std::size_t i = 0; i < channels_.span().size(); ++i) {
    const OutputChannel& channel = channels_.all[i];
    const double target = targetOf(channel, demand);
    const bool falls = isThrottle(channel.axis) && target < values_[i];
    const double reach = channel.slew_per_s * passed;
    const bool free = first || falls || channel.slew_per_s <= 0.0;
    values_[i] = free ? target : std::clamp(target, values_[i] - reach, values_[i] + reach);
  }
  return {values_.data(), channels_.span().size()};
}

}  // namespace helical
