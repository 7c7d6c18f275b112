#pragma once

#include "engine/transmitter/output_channel.h"
#include "engine/transmitter/radio_options.h"
#include "engine/transmitter/usb_transmitter.h"

namespace helical {

/// What a helicopter with the Crazyflie's firmware takes: degrees and degrees a second, thrust up to 60000.
inline constexpr ChannelLimits kCrazyradioLimits{-720.0, 720.0, 60000.0, false};

/// Crazyradio PA and 2.0: roll, pitch, yaw rate and thrust in one packet, each acknowledged by the helicopter. Demands
/// that are not are a fault. Every fifth of a second the helicopter's emergency-stop watchdog is fed; it cuts by itself a
/// second after that has ended. One thread.
class Crazyradio final : public UsbTransmitter {
 public:
  /// `channels` are valid within kCrazyradioLimits; without any, nothing but rest leaves.
  Crazyradio(UsbWanted wanted, const RadioOptions& radio, const OutputChannels& channels);

  static UsbWanted wanted(const std::string& serial);

 private:
  TransmitterTrouble begin(UsbDevice& device) override;
  TransmitterTrouble transmit(UsbDevice& device, const StickDemand& demand, TimeNs now, bool level) override;
  TransmitterTrouble sendPacket(UsbDevice& device, std::span<const std::uint8_t> packet);
  TransmitterTrouble drain(UsbDevice& device);
  TransmitterTrouble armWithRotors(UsbDevice& device, bool turn);

  RadioOptions radio_;
  ChannelMapper mapper_;
  bool acks_astray_ = true;  ///< one that was given up may still come
  bool armed_ = false;
  TimeNs fed_at_ = -kNanosecondsPerSecond;
};

}  // namespace helical
