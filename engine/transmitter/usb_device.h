#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/transmitter/transmitter_status.h"

namespace helical {

/// Which device is meant.
struct UsbWanted {
  std::uint16_t vendor = 0;
  std::vector<std::uint16_t> products;
  std::string serial;     ///< empty: the only one there is
  int timeout_ms = 50;    ///< of a transfer; 0 would be for ever
};

/// One that is plugged in.
struct UsbFound {
  std::uint16_t vendor = 0, product = 0;
  int bus = 0, address = 0;
  std::string name, serial;  ///< empty where it cannot be opened
  TransmitterTrouble trouble = TransmitterTrouble::kNone;
};

/// A USB device with its first interface claimed, through libusb. Transfers wait until they are done, or for the
/// time-out. After kAbsent nothing works any more: open it anew. One thread.
class UsbDevice {
 public:
  struct Opening;

  /// Never throws: a device that is not there is everyday life.
  static Opening open(const UsbWanted& wanted);
  /// All that are plugged in, by bus and address.
  static std::vector<UsbFound> list(const UsbWanted& wanted);
  ~UsbDevice();
  UsbDevice(const UsbDevice&) = delete;
  UsbDevice& operator=(const UsbDevice&) = delete;

  std::uint16_t product() const;
  const std::string& serial() const;
  bool hasOutEndpoint() const;

  TransmitterTrouble control(std::uint8_t request_type, std::uint8_t request, std::uint16_t value,
                             std::span<const std::uint8_t> data = {});
  /// To the first OUT endpoint; a stall is cleared before it is reported.
  TransmitterTrouble write(std::span<const std::uint8_t> data);
  /// From the first IN endpoint. `timeout_ms` 0: the device's.
  TransmitterTrouble read(std::span<std::uint8_t> data, std::size_t& count, int timeout_ms = 0);

 private:
  struct State;
  explicit UsbDevice(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

struct UsbDevice::Opening {
  std::unique_ptr<UsbDevice> device;  ///< null: see `trouble`
  TransmitterTrouble trouble = TransmitterTrouble::kNone;
};

}  // namespace helical
