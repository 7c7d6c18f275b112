// One usable camera is left for ten seconds: it stays within 0.3 m of where it should be, or lands. Twenty seeds, or
// $HELICAL_SEEDS.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "engine/config/plan_file.h"
#include "engine/config/resource_files.h"
#include "tests/pipeline/flight_fixture.h"

namespace helical {
namespace {

constexpr double kFromS = 10.0, kToS = 20.0;
constexpr double kNear = 0.3;  // m

bool survivesWithOneCamera(std::uint64_t seed) {
  RigConfig rig = test::shippedRig("calibrated", seed);
  const int left = static_cast<int>(seed % 3);
  test::cover(rig, {(left + 1) % 3, (left + 2) % 3}, kFromS, kToS);
  FlightPlan plan = loadPlan(planPath("hover"));
  plan.land_at_s = 60.0;
  LockStep flight(rig, plan);
  OperatorCommands commands;
  double farthest = 0.0;
  for (;;) {
    const EngineSnapshot& now = flight.tick(commands);
    commands.arm = commands.take_off = now.phase == FlightPhase::kIdle && now.failing_checks == 0;
    const double time_s = toSeconds(now.time);
    if (now.verdict.crashed) return false;
    if (time_s > kToS) return farthest < kNear;
    if (time_s < kFromS) continue;
    if (now.phase != FlightPhase::kFlying) return now.phase >= FlightPhase::kLanding;
    farthest =
        std::max(farthest, (now.truth.world_from_body.translation - now.set_point.position_in_world).norm());
  }
}

TEST(SingleCamera, HoldsForTenSecondsOrLands) {
  const char* wanted = std::getenv("HELICAL_SEEDS");
  const int seeds = wanted != nullptr ? std::atoi(wanted) : 20;
  int survived = 0;
  for (int seed = 1; seed <= seeds; ++seed) survived += survivesWithOneCamera(static_cast<std::uint64_t>(seed));
  std::printf("%d of %d\n", survived, seeds);
  EXPECT_GE(survived, 0.95 * seeds);
}

}  // namespace
}  // namespace helical
