#pragma once

#include <vector>

#include "engine/experiments/fault_flight.h"
#include "engine/pipeline/snapshot.h"

namespace helical {

/// Watches a flight's ticks for the moments at which its faults are noticed. Counts those alone that last longer than
/// their limit, begin when there is something to notice, and are hidden neither behind what was noticed before nor
/// behind a fault that leaves nothing to notice them by. Frames that are late or have wrong stamps are left out of the
/// flight: what is wrong with their images counts from when they are used again. One thread.
class FaultDetection {
 public:
  explicit FaultDetection(const std::vector<Fault>& faults);

  void add(const EngineSnapshot& tick);
  std::vector<Detection> result() const;

 private:
  struct Watched {
    Fault fault;
    double used_from_s = 0.0;  ///< when the frames that show it are used; before, it may be noticed, but need not
    bool began = false;
    bool counts = false;
    int knocks_before = 0;
    std::uint32_t changes_before = 0;
    double detected_s = -1.0;
    double watched_until_s = 0.0;
  };
  static bool wasWatchedForLong(const Watched& watched);
  static bool isNoticed(const Watched& watched, const EngineSnapshot& tick);

  std::vector<Watched> watched_;
};

}  // namespace helical
