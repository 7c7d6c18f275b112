#pragma once

#include <optional>
#include <string>

namespace helical {

/// When an exposure begins.
enum class TriggerMode { kFree, kSoftware, kLine, kAction };
/// Which instant of an exposure a camera's time stamp names.
enum class StampedAt { kStart, kMiddle, kEnd };

/// How a camera that is a device is set up, each time it is opened. What is not given stays as the camera has it,
/// format and rate apart. Settings that a kind of camera does not know are errors when it is opened.
struct DeviceOptions {
  std::string format;      ///< as GenICam or V4L2 name it; empty: Bayer of 8 bits if offered, else colour, else grey
  int offset_x = 0;        ///< of the region; its size is the camera's [px]
  int offset_y = 0;
  double rate_hz = 60.0;
  std::optional<double> exposure_us;
  std::optional<double> gain_db;
  std::optional<double> balance_red;   ///< over green
  std::optional<double> balance_blue;
  TriggerMode trigger = TriggerMode::kFree;
  std::string trigger_line = "Line1";
  bool ptp = false;  ///< the camera's clock follows the network's
  StampedAt stamped_at = StampedAt::kStart;
  double readout_ms = 8.0;  ///< mid-exposure to arrival, where the camera's clock cannot be read
  int packet_bytes = 1400;        ///< headers included: at most the network's MTU
  double packet_delay_us = 0.0;   ///< between packets, where cameras share a cable
  bool packet_resend = true;
  double frame_retention_ms = 30.0;  ///< how long an incomplete frame may wait for its packets, and others for it
  double silence_ms = 200.0;         ///< without a frame before the camera counts as lost, and five frames at least
  bool packet_socket = false;        ///< needs root, slower by milliseconds, spares the firewall
};

/// Throws Error(kInput) naming the offending key.
void validate(const DeviceOptions& options);

}  // namespace helical
