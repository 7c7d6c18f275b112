#include "engine/transmitter/channel_measurement.h"

#include <algorithm>
#include <utility>

#include "engine/base/error.h"
#include "engine/transmitter/output_device.h"

namespace helical {
namespace {

void demandNone(TransmitterTrouble trouble) {
  if (trouble != TransmitterTrouble::kNone)
    throw Error(ErrorKind::kDevice, toString(trouble), {}, cureOf(trouble));
}

}  // namespace

bool takesVoltages(const TransmitterOptions& transmitter) {
  return transmitter.kind == kMccDevice;
}

StickEnds endsOf(StickAxis axis) {
  switch (axis) {
    case StickAxis::kRoll:
      return {"fully to the left", "fully to the right"};
    case StickAxis::kPitch:
      return {"fully back (nose up)", "fully forward (nose down)"};
    case StickAxis::kYaw:
      return {"fully to the right", "fully to the left"};
    case StickAxis::kUpperRotor:
    case StickAxis::kLowerRotor:
    case StickAxis::kThrottle:
      break;
  }
  return {"at rest, motors off", "at full throttle"};
}

MeasuredEnds usualEnds(StickAxis axis) {
  MeasuredEnds ends;
  if (isThrottle(axis)) ends.low = 0.0;
  return ends;
}

OutputChannel channelOf(StickAxis axis, int output, const MeasuredEnds& ends, double slew_per_s) {
  OutputChannel channel;
  channel.axis = axis;
  channel.output = output;
  channel.minimum = std::min(ends.low, ends.high);
  channel.neutral = ends.neutral;
  channel.maximum = std::max(ends.low, ends.high);
  channel.reverse = ends.low > ends.high;
  channel.slew_per_s = slew_per_s;
  return channel;
}

std::array<StickAxis, 4> axesOf(bool mixed) {
  if (mixed) return {StickAxis::kThrottle, StickAxis::kYaw, StickAxis::kRoll, StickAxis::kPitch};
  return {StickAxis::kUpperRotor, StickAxis::kLowerRotor, StickAxis::kRoll, StickAxis::kPitch};
}

OutputChannels channelsOf(const FullDeflection& full) {
  OutputChannels channels;
  const auto add = [&](StickAxis axis, double minimum, double neutral, double maximum) {
    channels.all[static_cast<std::size_t>(channels.count)] = {axis, channels.count, minimum, neutral, maximum,
                                                              0.0,  false,          0.0};
    ++channels.count;
  };
  add(StickAxis::kThrottle, 0.0, 0.5 * full.thrust, full.thrust);
  add(StickAxis::kYaw, -full.yaw_deg_s, 0.0, full.yaw_deg_s);
  add(StickAxis::kRoll, -full.tilt_deg, 0.0, full.tilt_deg);
  add(StickAxis::kPitch, -full.tilt_deg, 0.0, full.tilt_deg);
  return channels;
}

OutputProbe::OutputProbe(const std::string& serial) {
  UsbDevice::Opening opening = UsbDevice::open(MccProtocol::wanted(serial));
  if (!opening.device) demandNone(opening.trouble);
  device_ = std::move(opening.device);
  count_ = MccProtocol::outputsOf(device_->product());
}

OutputProbe::~OutputProbe() {
  if (chosen_.count > 0) protocol_.begin(*device_, chosen_);  // 0 V
}

void OutputProbe::choose(int output, StickAxis axis) {
  chosen_.count = 1;
  chosen_.all[0].axis = axis;
  chosen_.all[0].output = output;
  begin(false);
}

void OutputProbe::begin(bool bipolar) {
  bipolar_ = bipolar;
  chosen_.all[0].minimum = bipolar ? -kHighestVolts : 0.0;
  demandNone(protocol_.begin(*device_, chosen_));
}

bool OutputProbe::put(double volts) {
  const double lowest = isThrottle(chosen_.all[0].axis) ? 0.0 : -kHighestVolts;
  const double allowed = std::clamp(volts, lowest, kHighestVolts);
  if ((allowed < 0.0) != bipolar_) begin(allowed < 0.0);
  demandNone(protocol_.put(*device_, chosen_, std::array{allowed}));
  return allowed == volts;
}

}  // namespace helical
