#pragma once

#include <atomic>
#include <cstdint>
#include <limits>

#include "engine/base/time.h"

namespace helical {

/// How a camera that is a device stands to this machine.
enum class LinkState : std::uint8_t {
  kAlways,     ///< no device: simulated, or a file
  kStreaming,
  kStalled,    ///< no frame for too long: given up, looked for again
  kTaken,      ///< another host controls it
  kLost,       ///< does not answer
  kOpening,    ///< answers again, gets its settings
};

/// What a camera that is a device has taken for its exposure and gain.
struct LightSetting {
  double exposure_us = 0.0;                                  ///< 0: it does not tell
  double gain = std::numeric_limits<double>::quiet_NaN();  ///< NaN: likewise
  bool gain_in_db = true;                                    ///< else in the device's own steps
};

/// What the threads of one camera's device tell the others, and what they count. Any thread; each counter has one
/// writer.
struct CameraLink {
  std::atomic<LinkState> state{LinkState::kAlways};
  std::atomic<std::uint64_t> returns{0};       ///< how often it came back
  std::atomic<std::uint64_t> incomplete{0};    ///< frames with packets that never came
  std::atomic<std::uint64_t> resent{0};        ///< packets that were asked for again and came
  std::atomic<std::uint64_t> overrun{0};       ///< frames that nobody fetched in time
  std::atomic<TimeNs> first_packet_to_frame{0};  ///< newest frame: its first packet's arrival to the frame in hand
  std::atomic<double> clock_drift{0.0};          ///< of its clock beside ours, relative
  std::atomic<double> clock_sigma_s{0.0};        ///< how well its clock is known
  std::atomic<double> exposure_us{LightSetting{}.exposure_us};  ///< these three: its LightSetting
  std::atomic<double> gain{LightSetting{}.gain};
  std::atomic<bool> gain_in_db{LightSetting{}.gain_in_db};

  void tell(const LightSetting& light) {
    exposure_us.store(light.exposure_us, std::memory_order_relaxed);
    gain_in_db.store(light.gain_in_db, std::memory_order_relaxed);
    gain.store(light.gain, std::memory_order_relaxed);
  }
};

}  // namespace helical
