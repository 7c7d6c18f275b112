#pragma once

#include <array>
#include <memory>
#include <string>

#include "engine/transmitter/mcc_analog_output.h"
#include "engine/transmitter/output_channel.h"
#include "engine/transmitter/transmitter_options.h"
#include "engine/transmitter/usb_device.h"

namespace helical {

/// Whether a transmitter is an analogue output, whose channels have to be measured; a radio's have units of their own.
bool takesVoltages(const TransmitterOptions& transmitter);

/// Of an analogue output; the lowest is as far below 0, for a throttle 0.
inline constexpr double kHighestVolts = 10.0;

/// What the ends of an axis look like, from its lower one to its upper one.
struct StickEnds {
  const char* low;
  const char* high;
};
StickEnds endsOf(StickAxis axis);

/// What an analogue output needs for the two ends of an axis and what lies between them, in volts. The lower
/// end may have the higher voltage.
struct MeasuredEnds {
  double low = 0.5;
  double neutral = 2.5;  ///< of throttle and rotors: half
  double high = 4.5;
};
MeasuredEnds usualEnds(StickAxis axis);

/// With a lower end above the upper one it is reversed.
OutputChannel channelOf(StickAxis axis, int output, const MeasuredEnds& ends, double slew_per_s);

/// The axes of a transmitter with one channel for throttle and one for yaw, or with one for each rotor.
std::array<StickAxis, 4> axesOf(bool mixed);

/// A radio's units are known: how much of them the operator wants.
struct FullDeflection {
  double thrust = 60'000.0;
  double yaw_deg_s = 200.0;
  double tilt_deg = 20.0;
};
OutputChannels channelsOf(const FullDeflection& full);

/// The analogue outputs of a device, one at a time, for an operator who tries voltages. One thread. All throw
/// Error(kDevice) when the device is missing or lost.
class OutputProbe {
 public:
  explicit OutputProbe(const std::string& serial);
  /// The output that was tried last goes to 0 V.
  ~OutputProbe();
  OutputProbe(const OutputProbe&) = delete;
  OutputProbe& operator=(const OutputProbe&) = delete;

  int count() const { return count_; }
  /// From now on `put` is about this one, 0 .. count() - 1; it begins at 0 V.
  void choose(int output, StickAxis axis);
  /// No more than the device and the axis allow; false when that was less than `volts`.
  bool put(double volts);

 private:
  void begin(bool bipolar);

  std::unique_ptr<UsbDevice> device_;
  MccProtocol protocol_;
  OutputChannels chosen_;
  bool bipolar_ = false;
  int count_ = 0;
};

}  // namespace helical
