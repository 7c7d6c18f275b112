#include "app/transmitter_calibration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/transmitter/mcc_analog_output.h"
#include "engine/transmitter/output_device.h"

namespace helical {
namespace {

/// What the ends of an axis look like, from its lower one to its upper one.
struct Words {
  const char* low;
  const char* high;
};

Words wordsOf(StickAxis axis) {
  switch (axis) {
    case StickAxis::kRoll:
      return {"fully to the left", "fully to the right"};
    case StickAxis::kPitch:
      return {"fully back (nose up)", "fully forward (nose down)"};
    case StickAxis::kYaw:
      return {"fully to the right", "fully to the left"};
    default:
      return {"at rest, motors off", "at full throttle"};
  }
}

[[noreturn]] void lose(TransmitterTrouble trouble) {
  throw Error(ErrorKind::kDevice, toString(trouble), {}, cureOf(trouble));
}

/// The analogue outputs by their number, in volts.
class Outputs {
 public:
  explicit Outputs(const std::string& serial) {
    UsbDevice::Opening opening = UsbDevice::open(MccProtocol::wanted(serial));
    if (!opening.device) lose(opening.trouble);
    device_ = std::move(opening.device);
    count_ = MccProtocol::outputsOf(device_->product());
  }
  ~Outputs() {
    if (chosen_.count > 0) protocol_.begin(*device_, chosen_);  // 0 V
  }
  Outputs(const Outputs&) = delete;
  Outputs& operator=(const Outputs&) = delete;

  int count() const { return count_; }
  /// From now on `put` is about this one; it begins at 0 V. `bipolar`: it may have to go below.
  void choose(int output, bool bipolar) {
    chosen_.count = 1;
    chosen_.all[0].output = output;
    chosen_.all[0].minimum = bipolar ? -10.0 : 0.0;
    check(protocol_.begin(*device_, chosen_));
  }
  void put(double volts) { check(protocol_.put(*device_, chosen_, std::array{volts})); }

 private:
  static void check(TransmitterTrouble trouble) {
    if (trouble != TransmitterTrouble::kNone) lose(trouble);
  }
  std::unique_ptr<UsbDevice> device_;
  MccProtocol protocol_;
  OutputChannels chosen_;
  int count_ = 0;
};

/// Three voltages that the operator has found.
std::optional<OutputChannel> measureChannel(Conversation& talk, Outputs& outputs, StickAxis axis, int usual_output) {
  OutputChannel channel;
  channel.axis = axis;
  const std::string name = toString(axis);
  for (;;) {
    const auto output = talk.askNumber("\n" + name + ": output", usual_output, [](double) {});
    if (!output) return std::nullopt;
    channel.output = static_cast<int>(*output);
    if (*output >= 0.0 && channel.output < outputs.count() && *output == std::floor(*output)) break;
    Conversation::say("  the device has outputs 0 to " + std::to_string(outputs.count() - 1) + "\n");
  }
  bool bipolar = false;
  outputs.choose(channel.output, bipolar);
  const auto put = [&](double volts) {
    if (std::abs(volts) > 10.0) Conversation::say("  it goes from -10 to 10 V\n");
    if ((volts < 0.0) != bipolar && !isThrottle(axis)) outputs.choose(channel.output, bipolar = volts < 0.0);
    outputs.put(std::clamp(volts, isThrottle(axis) ? 0.0 : -10.0, 10.0));
  };
  const Words words = wordsOf(axis);
  const bool throttle = isThrottle(axis);
  const auto low = talk.askNumber(name + ", volts " + words.low, throttle ? 0.0 : 0.5, put);
  if (!low) return std::nullopt;
  const auto neutral = talk.askNumber(name + (throttle ? ", volts at half" : ", volts at neutral"), 2.5, put);
  if (!neutral) return std::nullopt;
  const auto high = talk.askNumber(name + ", volts " + words.high, 4.5, put);
  if (!high) return std::nullopt;
  outputs.put(throttle ? *low : *neutral);
  channel.minimum = std::min(*low, *high);
  channel.maximum = std::max(*low, *high);
  channel.neutral = *neutral;
  channel.reverse = *low > *high;
  const auto slew = talk.askNumber(name + ", fastest change in volts a second, 0 for any", 0.0, [](double) {});
  if (!slew) return std::nullopt;
  channel.slew_per_s = *slew;
  return channel;
}

std::optional<OutputChannels> measureVoltages(Conversation& talk, const std::string& serial) {
  Outputs outputs(serial);
  Conversation::say(
      "Motors off: take their battery out, or disconnect them. Each question tries the voltage that is in brackets;\n"
      "another number tries that one, an empty line takes it. Ctrl-C gives up.\n");
  const auto mixed = talk.askYes("Does the transmitter have one channel for throttle and one for yaw (not one for each rotor)?");
  if (!mixed) return std::nullopt;
  const StickAxis first = *mixed ? StickAxis::kThrottle : StickAxis::kUpperRotor;
  const StickAxis second = *mixed ? StickAxis::kYaw : StickAxis::kLowerRotor;
  OutputChannels channels;
  for (const StickAxis axis : {first, second, StickAxis::kRoll, StickAxis::kPitch}) {
    const auto channel = measureChannel(talk, outputs, axis, channels.count);
    if (!channel) return std::nullopt;
    channels.all[static_cast<std::size_t>(channels.count++)] = *channel;
  }
  return channels;
}

/// A radio's units are known: what is to be found is how much the operator wants.
std::optional<OutputChannels> askForLimits(Conversation& talk) {
  OutputChannels channels;
  const auto add = [&](StickAxis axis, double minimum, double neutral, double maximum) {
    channels.all[static_cast<std::size_t>(channels.count)] = {axis, channels.count, minimum, neutral, maximum, 0.0, false, 0.0};
    ++channels.count;
  };
  const auto thrust = talk.askNumber("full throttle, up to 60000", 60000.0, [](double) {});
  if (!thrust) return std::nullopt;
  const auto yaw = talk.askNumber("full yaw, degrees a second", 200.0, [](double) {});
  if (!yaw) return std::nullopt;
  const auto tilt = talk.askNumber("full roll and pitch, degrees", 20.0, [](double) {});
  if (!tilt) return std::nullopt;
  add(StickAxis::kThrottle, 0.0, 0.5 * *thrust, *thrust);
  add(StickAxis::kYaw, -*yaw, 0.0, *yaw);
  add(StickAxis::kRoll, -*tilt, 0.0, *tilt);
  add(StickAxis::kPitch, -*tilt, 0.0, *tilt);
  return channels;
}

}  // namespace

std::optional<OutputChannels> measureChannels(Conversation& talk, const TransmitterOptions& transmitter) {
  const bool volts = transmitter.kind == kMccDevice;
  auto channels = volts ? measureVoltages(talk, transmitter.device) : askForLimits(talk);
  if (!channels) return std::nullopt;
  TransmitterOptions measured = transmitter;
  measured.channels = *channels;
  validate(measured);
  return channels;
}

}  // namespace helical
