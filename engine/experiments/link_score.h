#pragma once

#include <array>

#include "engine/base/latency_histogram.h"
#include "engine/pipeline/snapshot.h"

namespace helical {

/// How well the frames of cameras that are devices came, from a flight's ticks in order; while the rotors turned. One
/// thread.
class LinkScore {
 public:
  void add(const EngineSnapshot& tick);

  /// First packet to the frame in hand, of all network cameras' frames.
  const LatencyHistogram& transfer() const { return transfer_; }
  /// Longest time between two frames of a camera [s].
  double longestGap(CameraId camera) const { return longest_gap_s_[static_cast<std::size_t>(camera.index())]; }

 private:
  LatencyHistogram transfer_;
  std::array<TimeNs, kMaxCameras> last_exposure_{};
  std::array<double, kMaxCameras> longest_gap_s_{};
};

}  // namespace helical
