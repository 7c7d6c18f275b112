#pragma once

#include <array>
#include <cstddef>

#include "engine/base/time.h"

namespace helical {

/// A device's clock read at a time of ours that is known within `sigma`.
struct ClockSample {
  TimeNs device = 0;
  TimeNs host = 0;
  TimeNs sigma = 0;
};

/// From a camera's clock to this machine's: host = device + offset + drift * (device - reference), fitted by weighted
/// least squares to the newest samples. Where a camera's clock cannot be read, arrivals of frames stand in: of each
/// half second the one that was least delayed counts. One thread; allocates nothing.
class ClockMapping {
 public:
  /// Forgets everything: the device has restarted.
  void reset() { *this = ClockMapping(); }

  void add(const ClockSample& sample);
  /// A frame with this time stamp came at `host`, which was `usual_delay` after it or more.
  void addArrival(TimeNs device, TimeNs host, TimeNs usual_delay);

  bool known() const { return count_ > 0; }
  /// Before the first sample the same time: nothing better is known.
  TimeNs host(TimeNs device) const;
  double drift() const { return drift_; }
  /// Standard deviation of the offset at the newest sample.
  double sigma() const { return sigma_s_; }

 private:
  static constexpr std::size_t kKept = 64;
  void fit();

  std::array<ClockSample, kKept> samples_{};
  std::size_t count_ = 0;  ///< of samples ever taken
  TimeNs reference_ = 0;   ///< on the device's clock
  double offset_s_ = 0.0;  ///< beyond `base_`, at the reference
  TimeNs base_ = 0;        ///< host less device, about
  double drift_ = 0.0;
  double sigma_s_ = 0.0;
  ClockSample best_arrival_;  ///< of the half second that is going on
  TimeNs arrivals_since_ = -1;
};

}  // namespace helical
