#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/config/rig_config.h"
#include "engine/experiments/fault_plan.h"
#include "engine/flight/flight_plan.h"
#include "engine/simulator/verdict.h"

namespace helical {

/// Faster on the ground is hard [m/s].
inline constexpr double kHardTouch = 1.0;

/// A fault that was to be noticed, and whether it was.
struct Detection {
  FaultKind kind = FaultKind::kGust;
  double after_s = 0.0;  ///< infinite: never
};

/// One flight with faults.
struct FaultFlight {
  std::uint64_t seed = 0;
  std::vector<Fault> faults;
  Verdict verdict;
  std::string outcome;         ///< as `helical fly` has it
  bool flown = false;          ///< its rotors turned
  bool bad_arming = false;     ///< it armed in a state in which it must not
  double farthest_beyond = 0;  ///< the hard fence, with the rotors powered; true position [m], negative inside
  std::vector<Detection> detections;

  bool isHard() const { return verdict.crashed || verdict.hardest_touch > kHardTouch; }
};

/// Flies `plan` without images in lock step while the seed's faults happen. The operator orders to arm ten times a second,
/// whatever the checks say, and to take off once it is armed.
FaultFlight flyWithFaults(const RigConfig& rig, const FlightPlan& plan, std::uint64_t seed);

/// The same world, faults and supervisor, with the true state in place of what cameras see, and a processor that is never
/// late: what could have been done.
Verdict flyOracle(const RigConfig& rig, const FlightPlan& plan, std::uint64_t seed);

}  // namespace helical
