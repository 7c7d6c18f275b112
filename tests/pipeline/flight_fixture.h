#pragma once

#include <string>
#include <vector>

#include "engine/config/rig_config.h"
#include "engine/flight/flight_plan.h"
#include "engine/pipeline/flight_score.h"
#include "engine/pipeline/lock_step.h"

namespace helical::test {

/// A shipped rig ("paper", "calibrated") for a seed, image-free, with the default gusts.
RigConfig shippedRig(const std::string& name, std::uint64_t seed);

/// Covers these cameras, counted from 0, from one time to another.
void cover(RigConfig& rig, const std::vector<int>& cameras, double from_s, double to_s);

struct Flown {
  std::string outcome;
  FlightScore score;
  Verdict verdict;
  EngineSnapshot last;
  bool hard_touch_while_seen = false;  ///< faster than 1 m/s with a pose in the second before
};

/// Flies the hover plan in lock step until the rotors are off and it rests, or 45 s have passed.
Flown flyHover(const RigConfig& rig);

double median(std::vector<double> values);
double percentile(std::vector<double> values, double fraction);

}  // namespace helical::test
