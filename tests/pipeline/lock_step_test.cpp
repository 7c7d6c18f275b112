#include "engine/pipeline/lock_step.h"

#include <gtest/gtest.h>

#include <bit>

#include "engine/base/error.h"
#include "engine/config/plan_file.h"
#include "engine/config/resource_files.h"
#include "tests/pipeline/flight_fixture.h"

namespace helical {
namespace {

/// A digest of everything that a tick decides, down to the last bit.
std::uint64_t digest(const EngineSnapshot& tick, std::uint64_t before) {
  const auto mix = [&before](double value) {
    before = (std::rotl(before, 5) ^ std::bit_cast<std::uint64_t>(value)) * 0x9e3779b97f4a7c15ULL;
  };
  for (const HelicopterState* state : {&tick.tracked.state, &tick.truth}) {
    for (int i = 0; i < 3; ++i) mix(state->world_from_body.translation[i]);
    for (int i = 0; i < 4; ++i) mix(state->world_from_body.rotation.coeffs()[i]);
    for (int i = 0; i < 3; ++i) mix(state->velocity_in_world[i]);
  }
  for (int i = 0; i < 36; ++i) mix(tick.tracked.pose_covariance(i / 6, i % 6));
  for (const double stick :
       {tick.sticks.upper_rotor, tick.sticks.lower_rotor, tick.sticks.roll, tick.sticks.pitch})
    mix(stick);
  return before;
}

std::uint64_t fly(const RigConfig& rig, int ticks) {
  LockStep flight(rig, loadPlan(planPath("hover")));
  std::uint64_t result = 0;
  OperatorCommands commands;
  for (int i = 0; i < ticks; ++i) {
    commands.arm = commands.take_off = i == 60;
    result = digest(flight.tick(commands), result);
  }
  return result;
}

TEST(LockStep, RepeatsBitForBitForASeed) {
  RigConfig rig = test::shippedRig("paper", 11);
  rig.simulation.vary = 0.3;
  EXPECT_EQ(fly(rig, 600), fly(rig, 600));
  RigConfig other = rig;
  other.simulation.seed = 12;
  EXPECT_NE(fly(rig, 600), fly(other, 600));
}

TEST(LockStep, RepeatsBitForBitWithImages) {
  RigConfig rig = test::shippedRig("paper", 11);
  rig.simulation.images = true;
  EXPECT_EQ(fly(rig, 180), fly(rig, 180));
}

TEST(LockStep, TimeMovesByTheControlPeriod) {
  const RigConfig rig = test::shippedRig("paper", 1);
  LockStep flight(rig, FlightPlan{});
  TimeNs last = 0;
  for (int i = 0; i < 60; ++i) {
    const TimeNs now = flight.tick({}).time;
    EXPECT_NEAR(toSeconds(now - last), 1.0 / 60.0, 0.0011);
    last = now;
  }
  EXPECT_NEAR(toSeconds(last), 1.0, 0.0011);
}

TEST(LockStep, KillCutsTheSticksAtOnceAndForGood) {
  LockStep flight(test::shippedRig("paper", 1), loadPlan(planPath("hover")));
  OperatorCommands commands;
  for (int i = 0; i < 400; ++i) {
    commands.arm = commands.take_off = i == 60;
    flight.tick(commands);
  }
  commands.kill = true;
  EXPECT_EQ(flight.tick(commands).sticks, StickDemand{});
  commands.kill = false;
  commands.arm = commands.take_off = true;
  for (int i = 0; i < 120; ++i) {
    const EngineSnapshot& now = flight.tick(commands);
    EXPECT_EQ(now.sticks, StickDemand{});
    EXPECT_EQ(now.safety, SafetyState::kCut);
  }
}

/// Hovers until tick 500, changes what it is told, flies on and lands.
EngineSnapshot flyWithChange(std::uint64_t seed, const FlightChange& change) {
  FlightPlan plan = loadPlan(planPath("hover"));
  LockStep flight(test::shippedRig("paper", seed), plan);
  OperatorCommands commands;
  for (int i = 0; i < 2000; ++i) {
    commands.arm = commands.take_off = i == 60;
    if (i == 500) flight.change(change);
    flight.tick(commands);
  }
  return flight.tick({});
}

TEST(LockStep, EveryGainAndTrimIsSafeToTheEndsOfItsRange) {
  for (const ControllerKey& key : controllerKeys())
    for (const double value : {key.lowest, key.highest}) {
      ControllerOptions control = test::shippedRig("paper", 3).control;
      control.*key.value = value;
      const EngineSnapshot end = flyWithChange(3, {{}, control});
      EXPECT_EQ(end.controls, 1U);
      EXPECT_FALSE(end.verdict.crashed) << key.name << " = " << value << ": " << end.verdict.reason;
      EXPECT_EQ(end.phase, FlightPhase::kOff) << key.name << " = " << value;
      EXPECT_NE(end.safety, SafetyState::kCut) << key.name << " = " << value;
    }
}

TEST(LockStep, TrimsReachTheSticks) {
  RigConfig rig = test::shippedRig("paper", 3);
  rig.simulation.gust_factor = 0.0;
  LockStep plain(rig, loadPlan(planPath("hover")));
  LockStep trimmed(rig, loadPlan(planPath("hover")));
  OperatorCommands commands;
  for (int i = 0; i <= 500; ++i) {
    commands.arm = commands.take_off = i == 60;
    if (i == 500) {
      ControllerOptions control = rig.control;
      control.trim_roll = 0.05;
      control.trim_lower = -0.02;
      trimmed.change({{}, control});
    }
    plain.tick(commands);
    trimmed.tick(commands);
  }
  // The tick itself: later the integrators have taken them back.
  const StickDemand without = plain.tick({}).sticks, with = trimmed.tick({}).sticks;
  EXPECT_GT(with.roll - without.roll, 0.03);
  EXPECT_LT(with.lower_rotor - without.lower_rotor, -0.01);
}

TEST(LockStep, AChangedPlanIsFlownAndABadOneChangesNothing) {
  FlightChange change;
  change.plan = loadPlan(planPath("hover"));
  change.plan->land_at_s = 0.0;
  change.plan->waypoints = {{{0.3, -0.2, 0.8}, 0.0, 1e6, 0.3}};
  const EngineSnapshot end = flyWithChange(3, change);
  EXPECT_EQ(end.plans, 1U);
  EXPECT_EQ(end.phase, FlightPhase::kFlying) << "this one does not land";
  EXPECT_LT((end.truth.world_from_body.translation.head<2>() - Eigen::Vector2d(0.3, -0.2)).norm(), 0.15);

  LockStep flight(test::shippedRig("paper", 3), loadPlan(planPath("hover")));
  change.plan->waypoints.clear();
  EXPECT_THROW(flight.change(change), Error);
  EXPECT_EQ(flight.tick({}).plans, 0U);
}

TEST(LockStep, AHiddenCameraIsNotUsed) {
  LockStep flight(test::shippedRig("paper", 1), loadPlan(planPath("hover")));
  for (int i = 0; i < 90; ++i) flight.tick({});
  flight.hideCamera(cameraId(1), true);
  flight.tick({});
  const EngineSnapshot& now = flight.tick({});
  EXPECT_TRUE(now.cameras[1].hidden);
  EXPECT_EQ(now.cameras[1].track.selected_count, 0);
  EXPECT_EQ(now.cameras[0].track.selected_count, 4);
  EXPECT_GT(now.cameras[1].frames, 80u);
}

}  // namespace
}  // namespace helical
