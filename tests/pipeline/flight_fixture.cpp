#include "tests/pipeline/flight_fixture.h"

#include <algorithm>
#include <cmath>

#include "engine/config/plan_file.h"
#include "engine/config/resource_files.h"
#include "engine/config/rig_file.h"

namespace helical::test {

RigConfig shippedRig(const std::string& name, std::uint64_t seed) {
  RigConfig rig = loadRig(resourceFolder() / "rigs" / (name + ".toml"));
  rig.simulation.seed = seed;
  rig.simulation.images = false;
  rig.safety.arm_rate_share = 0.1;  // a machine that runs other tests, too, loses frames and ticks
  return rig;
}

void cover(RigConfig& rig, const std::vector<int>& cameras, double from_s, double to_s) {
  for (const int camera : cameras) rig.simulation.occlusions.push_back({cameraId(camera), from_s, to_s});
}

Flown flyHover(const RigConfig& rig) {
  const FlightPlan plan = loadPlan(planPath("hover"));
  LockStep flight(rig, plan);
  Flown flown;
  OperatorCommands commands;
  for (;;) {
    const EngineSnapshot& now = flight.tick(commands);
    flown.score.add(now);
    if (now.verdict.hardest_touch > 1.0 && flown.verdict.hardest_touch <= 1.0 &&
        toSeconds(now.pose_age) < 1.0)
      flown.hard_touch_while_seen = true;
    flown.verdict = now.verdict;
    flown.last = now;
    commands.arm = commands.take_off = now.phase == FlightPhase::kIdle && now.failing_checks == 0;
    const bool over = now.verdict.crashed || (now.phase == FlightPhase::kOff && now.verdict.at_rest);
    if (over || toSeconds(now.time) > 45.0) break;
  }
  flown.outcome = outcomeOf(flown.verdict, flown.score.failsafes());
  return flown;
}

double percentile(std::vector<double> values, double fraction) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  const auto index = static_cast<std::size_t>(fraction * static_cast<double>(values.size()));
  return values[std::min(index, values.size() - 1)];
}

double median(std::vector<double> values) {
  return percentile(std::move(values), 0.5);
}

}  // namespace helical::test
