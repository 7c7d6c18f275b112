#pragma once

#include <cstdint>

#include "engine/base/random.h"
#include "engine/base/time.h"
#include "engine/simulator/simulation_options.h"

namespace helical {

/// A simulated camera's own free-running clock: drawn phase, drawn rate error, read-out delay with a little
/// jitter. One thread.
class ExposureClock {
 public:
  ExposureClock(const SimulationOptions& options, Random random);

  TimeNs exposure() const { return exposure_; }  ///< of the next frame
  TimeNs arrival() const { return arrival_; }    ///< of the next frame
  std::uint64_t sequence() const { return sequence_; }
  void next();
  /// Frames that would have arrived long before `now` are lost, as on a camera that nobody reads.
  void skipLost(TimeNs now);

 private:
  void schedule();

  Random random_;
  double period_s_;
  double phase_s_;
  double readout_s_;
  std::uint64_t sequence_ = 0;
  TimeNs exposure_ = 0;
  TimeNs arrival_ = 0;
};

}  // namespace helical
