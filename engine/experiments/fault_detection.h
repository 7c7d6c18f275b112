#pragma once

#include <vector>

#include "engine/experiments/fault_flight.h"
#include "engine/pipeline/snapshot.h"

namespace helical {

/// Watches a flight's ticks for the moments at which its faults are noticed. Counts those alone that last longer than
/// their limit, begin when there is something to notice, and are hidden neither behind what was noticed before nor
/// behind a fault that leaves nothing to notice them by. One thread.
class FaultDetection {
 public:
  explicit FaultDetection(const std::vector<Fault>& faults);

  void add(const EngineSnapshot& tick);
  std::vector<Detection> result() const;

 private:
  struct Watched {
    Fault fault;
    bool began = false;
    bool counts = false;
    int knocks_before = 0;
    double detected_s = -1.0;
    double watched_until_s = 0.0;
  };
  static bool isNoticed(const Watched& watched, const EngineSnapshot& tick);

  std::vector<Watched> watched_;
};

}  // namespace helical
