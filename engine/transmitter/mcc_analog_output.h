#pragma once

#include <array>

#include "engine/transmitter/output_channel.h"
#include "engine/transmitter/usb_transmitter.h"

namespace helical {

/// What an analogue output gives.
inline constexpr ChannelLimits kMccLimits{-10.0, 10.0, 10.0, true};

/// The reports of the MCC USB-3101 to 3114 analogue outputs (16 bits, 0 to 10 V or +-10 V), and the voltages that the
/// device itself is calibrated for. One thread.
class MccProtocol {
 public:
  /// Each output that `channels` names: its range, 0 V, and its calibration as it is stored in the device.
  TransmitterTrouble begin(UsbDevice& device, const OutputChannels& channels);
  /// All at one instant where the device can do that. `volts` in the channels' order.
  TransmitterTrouble put(UsbDevice& device, const OutputChannels& channels, std::span<const double> volts) const;
  /// The digital output 0.
  static TransmitterTrouble putBit(UsbDevice& device, bool level);
  /// A digital input; `configureInput` before the first time.
  static TransmitterTrouble configureInput(UsbDevice& device, int bit);
  static TransmitterTrouble getBit(UsbDevice& device, int bit, bool& level);

  /// Vendor and product ids.
  static UsbWanted wanted(const std::string& serial);
  static int outputsOf(std::uint16_t product);

 private:
  struct Output {
    bool bipolar = false;
    float slope = 1.0f, offset = 0.0f;
  };
  TransmitterTrouble readCalibration(UsbDevice& device, int output);
  TransmitterTrouble becomeMaster(UsbDevice& device);
  std::uint16_t codeOf(int output, double volts) const;

  std::array<Output, 16> outputs_{};
  bool synchronous_ = false;
};

/// The sticks as voltages: into a transmitter's potentiometer inputs, as the paper has it. A digital output toggles with
/// each demand that has gone out. One thread.
class MccAnalogOutput final : public UsbTransmitter {
 public:
  /// `channels` are valid within kMccLimits; without any, nothing but the heartbeat leaves. `trainer_input`: the digital
  /// input that is high (as it is without a wire) when the pilot's own transmitter flies; negative: none.
  MccAnalogOutput(UsbWanted wanted, const OutputChannels& channels, int trainer_input = -1);

 private:
  TransmitterTrouble begin(UsbDevice& device) override;
  TransmitterTrouble transmit(UsbDevice& device, const StickDemand& demand, TimeNs now, bool level) override;

  ChannelMapper mapper_;
  MccProtocol protocol_;
  int trainer_input_;
};

}  // namespace helical
