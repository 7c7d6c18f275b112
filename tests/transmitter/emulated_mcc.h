#pragma once

#include <array>
#include <deque>
#include <string>

#include "tests/transmitter/emulated_device.h"

namespace helical {

/// An MCC USB-3103 and its kin: 16-bit voltage outputs, each with a converter that is a little off, and the correction for
/// that stored in the device as its maker does. Written after the device's protocol, not after our code.
class EmulatedMcc final : public EmulatedDevice {
 public:
  explicit EmulatedMcc(std::string serial = "01A2B3C4", std::uint16_t product = 0x009C, bool out_endpoint = true);

  /// At the terminals, as a voltmeter would have it.
  double volts(int output) const { return volts_[static_cast<std::size_t>(output)]; }
  bool bipolar(int output) const { return bipolar_[static_cast<std::size_t>(output)]; }

  /// What the next reports meet.
  int stalls = 0, hangs = 0;
  /// What it was told.
  std::vector<UsbBytes> reports;
  int writes = 0;          ///< of voltages
  int toggles = 0;         ///< of the digital output 0
  bool bit_drives = false;  ///< it is an output
  bool was_torn = false;    ///< voltages changed one by one
  std::uint8_t master_value = 1;  ///< of SET_SYNC that makes it the master: the sources do not agree
  bool calibrated = true;
  bool trainer = false;  ///< level of input 3, once it is an input

  UsbBytes descriptors() const override;
  UsbReply control(const UsbSetup& setup, const UsbBytes& data) override;
  UsbReply out(std::uint8_t endpoint, const UsbBytes& data) override;
  UsbReply in(std::uint8_t endpoint) override;

 private:
  UsbReply report(const UsbBytes& report);
  void readMemory(int address, int count);
  void convert(std::size_t output, int code);
  float slopeOf(std::size_t output, bool bipolar) const;
  float offsetOf(std::size_t output, bool bipolar) const;

  std::string serial_;
  std::uint16_t product_;
  bool out_endpoint_;
  std::array<double, 16> volts_{};
  std::array<bool, 16> bipolar_{};
  std::array<int, 16> latched_{};  ///< -1: none
  bool master_ = false;
  bool bit_ = false;
  bool input_ = false;
  std::deque<UsbBytes> replies_;
};

}  // namespace helical
