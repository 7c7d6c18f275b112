#pragma once

#include <atomic>
#include <cstdint>

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
};

}  // namespace helical
