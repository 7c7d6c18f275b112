#include "engine/experiments/fault_study.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/experiments/parallel_runs.h"
#include "engine/experiments/statistics.h"

namespace helical {
namespace {

FaultRow rowOf(FaultKind kind, const std::vector<FaultFlight>& flights) {
  FaultRow row;
  row.kind = kind;
  row.median_s = row.longest_s = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> times;
  double worst = -1.0;
  for (const FaultFlight& flight : flights) {
    row.runs += std::any_of(flight.faults.begin(), flight.faults.end(), [&](const Fault& f) { return f.kind == kind; });
    for (const Detection& detection : flight.detections) {
      if (detection.kind != kind) continue;
      ++row.counted;
      if (detection.after_s > worst) row.worst_seed = flight.seed;
      worst = std::max(worst, detection.after_s);
      if (std::isinf(detection.after_s))
        ++row.missed;
      else
        times.push_back(detection.after_s);
    }
  }
  if (times.empty()) return row;
  row.median_s = quantile(times, 0.5);
  row.longest_s = *std::max_element(times.begin(), times.end());
  return row;
}

}  // namespace

std::vector<FaultRow> FaultStudy::rows() const {
  std::vector<FaultRow> all;
  for (int kind = 0; kind < kFaultKindCount; ++kind) all.push_back(rowOf(static_cast<FaultKind>(kind), flights));
  return all;
}

FaultStudy studyFaults(const RigConfig& rig, const FlightPlan& plan, int runs, std::uint64_t first_seed,
                       const std::function<void(int)>& progress) {
  FaultStudy study;
  study.flights.resize(static_cast<std::size_t>(runs));
  std::vector<std::uint8_t> oracle_hard(study.flights.size(), 0);
  forEachRun(
      runs,
      [&](int run) {
        const std::uint64_t seed = first_seed + static_cast<std::uint64_t>(run);
        FaultFlight& flight = study.flights[static_cast<std::size_t>(run)];
        flight = flyWithFaults(rig, plan, seed);
        if (!flight.isHard()) return;
        const Verdict oracle = flyOracle(rig, plan, seed);
        oracle_hard[static_cast<std::size_t>(run)] = oracle.crashed || oracle.hardest_touch > kHardTouch;
      },
      progress);
  for (std::size_t i = 0; i < study.flights.size(); ++i) {
    const FaultFlight& flight = study.flights[i];
    if (flight.farthest_beyond > kPoweredBeyondM) study.breaches.push_back(flight.seed);
    if (flight.isHard()) (oracle_hard[i] != 0 ? study.excused : study.hard_landings).push_back(flight.seed);
    if (flight.bad_arming) study.bad_armings.push_back(flight.seed);
  }
  return study;
}

}  // namespace helical
