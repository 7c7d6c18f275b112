#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "engine/base/time.h"
#include "engine/helicopter/stick_demand.h"

namespace helical {

/// What a channel carries: a rotor each, or their mean and difference, and the swash plate.
enum class StickAxis : std::uint8_t { kUpperRotor, kLowerRotor, kThrottle, kYaw, kRoll, kPitch };
inline constexpr std::array kAllAxes{StickAxis::kUpperRotor, StickAxis::kLowerRotor, StickAxis::kThrottle,
                                     StickAxis::kYaw,        StickAxis::kRoll,       StickAxis::kPitch};

const char* toString(StickAxis axis);
/// Throttle and rotors: from rest to full, 0 .. 1. The others: from one end to the other, -1 .. 1.
bool isThrottle(StickAxis axis);
/// The axis' value in a demand; yaw is positive to the left, the lower rotor less the upper one.
double valueOf(StickAxis axis, const StickDemand& demand);

/// How one channel of a device carries its axis. `minimum`, `neutral`, `maximum` and `trim` are in the device's
/// unit: volts at an analogue output; at a radio that takes set-points degrees (roll, pitch), degrees a second
/// (yaw) and thrust from 0 to 60000. In between it is linear; `trim` moves `neutral` alone.
struct OutputChannel {
  StickAxis axis = StickAxis::kThrottle;
  int output = 0;  ///< of the device, from 0
  double minimum = 0.0;
  double neutral = 0.0;  ///< of throttle and rotors: at half
  double maximum = 0.0;
  double trim = 0.0;
  bool reverse = false;     ///< the other way round; never a throttle
  double slew_per_s = 0.0;  ///< the fastest change, but for a throttle that goes down; 0: no limit
};

/// A device's channels, to be shared between processes.
struct OutputChannels {
  std::array<OutputChannel, 8> all{};
  int count = 0;

  std::span<const OutputChannel> span() const { return {all.data(), static_cast<std::size_t>(count)}; }
};

/// What a device's unit allows.
struct ChannelLimits {
  double low = -10.0, high = 10.0;   ///< of every channel but throttle and rotors
  double throttle_high = 10.0;       ///< of those; their lower end is 0, where a device is that was just plugged in
  bool mixes_rotors = true;          ///< takes rotors; otherwise throttle and yaw only
};

/// No channel at all is valid: nobody has measured them yet. Otherwise roll and pitch, and both rotors or throttle
/// and yaw, each once and on an output of its own. Throws Error(kInput).
void validate(const OutputChannels& channels, const ChannelLimits& limits);

/// Of all that decides which way and how far a stick goes: what was looked at once counts until that changes.
std::uint64_t fingerprintOf(const OutputChannels& channels);

/// The channels' values in the device's unit, with their slew limits. One thread.
class ChannelMapper {
 public:
  explicit ChannelMapper(const OutputChannels& channels) : channels_(channels) {}

  /// In the channels' order; valid until the next call.
  std::span<const double> step(const StickDemand& demand, TimeNs now);
  const OutputChannels& channels() const { return channels_; }

 private:
  OutputChannels channels_;
  std::array<double, 8> values_{};
  TimeNs last_ = -1;
};

}  // namespace helical
