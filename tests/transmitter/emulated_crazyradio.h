#pragma once

#include <array>
#include <deque>

#include "tests/transmitter/emulated_device.h"

namespace helical {

/// A Crazyradio with a helicopter at the other end.
class EmulatedCrazyradio final : public EmulatedDevice {
 public:
  std::array<int, 256> settings{};  ///< by request
  UsbBytes address;
  std::vector<UsbBytes> packets;
  bool hears = true;     ///< the helicopter answers
  int late_answers = 0;  ///< so many answers are held back until their release

  void release();

  UsbBytes descriptors() const override;
  UsbReply control(const UsbSetup& setup, const UsbBytes& data) override;
  UsbReply out(std::uint8_t endpoint, const UsbBytes& data) override;
  UsbReply in(std::uint8_t endpoint) override;

  /// Of the kind, `first` being its header.
  std::vector<UsbBytes> packetsOf(std::uint8_t first) const;

 private:
  std::deque<UsbBytes> answers_, held_;
};

}  // namespace helical
