#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "engine/simulator/datagram_socket.h"
#include "engine/simulator/gige/device_clock.h"
#include "engine/simulator/gige/registers.h"

namespace helical::gige {

/// Answers of the control channel, as GigE Vision numbers them.
enum class Status : std::uint16_t {
  kSuccess = 0x0000,
  kNotImplemented = 0x8001,
  kInvalidParameter = 0x8002,
  kInvalidAddress = 0x8003,
  kWriteProtected = 0x8004,
  kAccessDenied = 0x8006,
};

/// Who a virtual camera is.
struct Identity {
  std::uint32_t ip = 0;  ///< host byte order
  std::string serial;    ///< up to 15 characters
  std::string user_name;
  int width = 640;  ///< of the sensor; even
  int height = 480;
};

/// How the next exposure is taken and where it goes.
struct Exposing {
  bool acquiring = false;  ///< and somebody listens
  bool triggered = false;
  bool chunks = false;  ///< a timestamp of the exposure follows the pixels
  double rate_hz = 60.0;
  double exposure_us = 2000.0;
  double gain = 1.0;           ///< of light, relative to 0 dB
  double balance[3] = {1, 1, 1};  ///< red, green, blue
  std::uint32_t format = 0;
  int width = 0, height = 0, offset_x = 0, offset_y = 0;
  std::uint32_t packet_size = 1400;
  TimeNs packet_delay = 0;
  Peer listener;
};

/// What a virtual camera remembers, and what reading and writing it means: one controller at a time while its
/// heartbeat lasts, settings checked as a camera's firmware does. One thread at a time; times on CLOCK_MONOTONIC.
class DeviceState {
 public:
  explicit DeviceState(const Identity& identity);

  /// Factory settings, no controller, a clock that begins at 0.
  void restart(TimeNs now);

  Status read(std::uint32_t address, std::uint32_t& value) const;
  Status read(std::uint32_t address, std::uint32_t size, std::span<const std::uint8_t>& bytes) const;
  Status write(std::uint32_t address, std::uint32_t value, const Peer& from, TimeNs now);
  Status write(std::uint32_t address, std::span<const std::uint8_t> bytes, const Peer& from, TimeNs now);
  /// A command came from here: the controller is alive.
  void heard(const Peer& from, TimeNs now);
  /// Lets a silent controller go.
  void expire(TimeNs now);

  bool controlled() const { return controller_.port != 0; }
  /// Another host, somewhere, takes it and listens to nothing; or lets it go.
  void take(bool taken);

  Exposing exposing() const;
  /// When a triggered exposure is to start, on CLOCK_MONOTONIC, once after it was ordered; nothing before.
  std::optional<TimeNs> takeTrigger() { return std::exchange(trigger_, std::nullopt); }
  /// Each true once after the client ordered it.
  bool takeTestPacketOrder();
  bool takeResetOrder();
  /// The exposure starts at `when` on its clock, at once if that has passed.
  void triggerAt(TimeNs when, TimeNs now);
  /// A pulse on line 1.
  void pulse(TimeNs now);
  bool actionIsMine(std::uint32_t device_key, std::uint32_t group_key, std::uint32_t group_mask) const;

  DeviceClock& clock() { return clock_; }
  /// Nanoseconds on its clock; PTP makes that the world's.
  TimeNs deviceTime(TimeNs now) const;
  std::span<const std::uint8_t> discoveryBlock() const { return memory_.bytes(0, 0xf8); }

 private:
  bool mayWrite(const Peer& from) const;
  Status writeFeature(std::uint32_t address, std::uint32_t value);
  Status writeReal(std::uint32_t address, double value);
  void release();
  void derive();

  Identity identity_;
  RegisterMemory memory_;
  DeviceClock clock_;
  Peer controller_;
  TimeNs heard_ = 0;
  bool taken_ = false;
  std::optional<TimeNs> trigger_;
  bool test_packet_ = false;
  bool reset_ = false;
};

/// What follows the pixels of a frame with chunks: of the image its description alone, then the timestamp with its own.
inline constexpr std::uint32_t kChunkBytes = 8 + 8 + 8;

/// 0 for a format that the camera does not offer.
int bitsPerPixel(std::uint32_t format);

}  // namespace helical::gige
