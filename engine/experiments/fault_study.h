#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "engine/experiments/fault_flight.h"

namespace helical {

/// How far outside the hard fence it may be powered [m].
inline constexpr double kPoweredBeyondM = 0.3;

/// A kind of fault over all flights.
struct FaultRow {
  FaultKind kind = FaultKind::kGust;
  int runs = 0;                ///< flights that had it
  int counted = 0;             ///< of those, where it was there to be noticed
  int missed = 0;              ///< and was not
  double median_s = 0.0;       ///< of the detection, NaN without any
  double longest_s = 0.0;      ///< likewise
  std::uint64_t worst_seed = 0;  ///< of the longest, or of one that was missed
};

/// What `helical experiment faults` reports.
struct FaultStudy {
  std::vector<FaultFlight> flights;  ///< in the order of seeds
  std::vector<std::uint64_t> breaches;       ///< seeds powered too far outside the hard fence
  std::vector<std::uint64_t> hard_landings;  ///< seeds that hit the ground hard where the oracle did not
  std::vector<std::uint64_t> excused;        ///< seeds where the oracle did, too
  std::vector<std::uint64_t> bad_armings;

  std::vector<FaultRow> rows() const;
};

/// Seeds `first_seed` .. `first_seed` + `runs` - 1 on all cores; progress hears how many are done.
FaultStudy studyFaults(const RigConfig& rig, const FlightPlan& plan, int runs, std::uint64_t first_seed,
                       const std::function<void(int)>& progress);

}  // namespace helical
