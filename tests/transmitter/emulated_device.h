#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <vector>

namespace helical {

using UsbBytes = std::vector<std::uint8_t>;

/// A request on endpoint 0.
struct UsbSetup {
  std::uint8_t type = 0, request = 0;
  std::uint16_t value = 0, index = 0, length = 0;
};

/// What a device makes of a transfer.
struct UsbReply {
  int status = 0;  ///< 0, or as the kernel has it: -EPIPE, -EPROTO
  UsbBytes in;
  bool pending = false;  ///< not yet: an IN without data, or a device that hangs

  static UsbReply stall();
  static UsbReply later() { return {0, {}, true}; }
  static UsbReply of(UsbBytes bytes) { return {0, std::move(bytes), false}; }
};

/// A USB device as the bus sees it. Called with `mutex` locked, which a test locks to look at what it holds.
class EmulatedDevice {
 public:
  virtual ~EmulatedDevice() = default;

  /// Device descriptor, then the configuration's.
  virtual UsbBytes descriptors() const = 0;
  virtual UsbReply control(const UsbSetup& setup, const UsbBytes& data);
  virtual UsbReply out(std::uint8_t endpoint, const UsbBytes& data) = 0;
  virtual UsbReply in(std::uint8_t endpoint) = 0;

  std::mutex mutex;

 protected:
  /// Descriptor of vendor, product and serial number, in this order from 1.
  static UsbReply text(const UsbSetup& setup, const std::vector<const char*>& texts);
};

}  // namespace helical
