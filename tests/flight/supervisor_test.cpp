#include "engine/flight/supervisor.h"

#include <gtest/gtest.h>

#include "engine/base/random.h"

namespace helical {
namespace {

constexpr double kTick = 1.0 / 60.0;

bool raised(const SupervisorMemory& memory, Failsafe failsafe) {
  return (memory.failsafes & static_cast<std::uint32_t>(failsafe)) != 0;
}

/// A supervisor in flight at 60 ticks per second; tests change the conditions.
struct Flight {
  SupervisorOptions options;
  SupervisorMemory memory;
  SupervisorConditions conditions;

  Flight() {
    conditions.phase = FlightPhase::kFlying;
    conditions.height_above_pad = 0.6;
  }
  const SupervisorMemory& tick() {
    conditions.now += fromSeconds(kTick);
    conditions.flight_time_s += kTick;
    return memory = supervise(options, memory, conditions);
  }
  /// Ticks without a pose for as long as `seconds`.
  void blindFor(double seconds) {
    const double end = conditions.pose_age_s + seconds;
    while (conditions.pose_age_s + kTick <= end) {
      conditions.pose_age_s += kTick;
      tick();
    }
  }
  SafetyState state() const { return memory.state; }
};

TEST(Supervisor, LeavesAQuietFlightAlone) {
  Flight flight;
  for (int i = 0; i < 600; ++i) flight.tick();
  EXPECT_EQ(flight.state(), SafetyState::kNormal);
  EXPECT_EQ(flight.memory.failsafes, 0u);
}

TEST(Supervisor, CoastsAfterAMomentWithoutPoseAndRecoversAtOnce) {
  Flight flight;
  flight.blindFor(0.05);
  EXPECT_EQ(flight.state(), SafetyState::kNormal);
  flight.blindFor(0.02);
  EXPECT_EQ(flight.state(), SafetyState::kCoasting);
  EXPECT_TRUE(raised(flight.memory, Failsafe::kNoPoseCoast));
  flight.conditions.pose_age_s = 0.0;
  EXPECT_EQ(flight.tick().state, SafetyState::kNormal);
  EXPECT_TRUE(raised(flight.memory, Failsafe::kNoPoseCoast)) << "what happened stays on record";
}

TEST(Supervisor, DescendsWithoutPoseForLongAndRecoversAtOnce) {
  Flight flight;
  flight.blindFor(0.5);
  EXPECT_EQ(flight.state(), SafetyState::kCoasting);
  flight.blindFor(0.1);
  EXPECT_EQ(flight.state(), SafetyState::kDescending);
  EXPECT_TRUE(raised(flight.memory, Failsafe::kNoPoseDescent));
  flight.conditions.pose_age_s = 0.01;
  EXPECT_EQ(flight.tick().state, SafetyState::kNormal);
  EXPECT_LT(flight.memory.descending_since, 0);
}

TEST(Supervisor, CutsWhenTheDescentIsOver) {
  for (const double height : {0.2, 0.6, 1.5}) {
    Flight flight;
    flight.conditions.height_above_pad = height;
    flight.blindFor(0.5 + 2 * kTick);
    ASSERT_EQ(flight.state(), SafetyState::kDescending);
    const double down = height / flight.options.descent_speed + kSettleOnSkids;
    EXPECT_NEAR(flight.memory.descent_s, down, 1e-9);
    // Where it believes to be now means nothing: the time was fixed when the descent began.
    flight.conditions.height_above_pad = 40.0;
    flight.blindFor(down - 3 * kTick);
    EXPECT_EQ(flight.state(), SafetyState::kDescending);
    flight.blindFor(5 * kTick);
    EXPECT_EQ(flight.state(), SafetyState::kCut);
    EXPECT_TRUE(raised(flight.memory, Failsafe::kNoPoseCut));
  }
}

TEST(Supervisor, DescentIsNeverLongerThanItsLimit) {
  Flight flight;
  flight.blindFor(0.1);
  flight.conditions.height_above_pad = 100.0;
  flight.blindFor(0.4 + flight.options.longest_descent_s - 2 * kTick);
  EXPECT_EQ(flight.state(), SafetyState::kDescending);
  flight.blindFor(5 * kTick);
  EXPECT_EQ(flight.state(), SafetyState::kCut);
}

TEST(Supervisor, EveryDescentHasItsOwnTime) {
  Flight flight;
  flight.blindFor(1.0);
  ASSERT_EQ(flight.state(), SafetyState::kDescending);
  flight.conditions.pose_age_s = 0.0;
  flight.tick();
  flight.blindFor(0.5 + flight.memory.descent_s - 0.2);
  EXPECT_EQ(flight.state(), SafetyState::kDescending);
}

TEST(Supervisor, CutsWhenTiltedForLong) {
  Flight flight;
  flight.conditions.tilt = 1.05;
  for (int i = 0; i < 18; ++i) flight.tick();
  EXPECT_EQ(flight.state(), SafetyState::kNormal);
  for (int i = 0; i < 3; ++i) flight.tick();
  EXPECT_EQ(flight.state(), SafetyState::kCut);
  EXPECT_TRUE(raised(flight.memory, Failsafe::kTilt));
}

TEST(Supervisor, TiltThatEndsStartsItsTimeAnew) {
  Flight flight;
  for (int swing = 0; swing < 10; ++swing) {
    flight.conditions.tilt = 1.2;
    for (int i = 0; i < 15; ++i) flight.tick();
    flight.conditions.tilt = 0.9;
    flight.tick();
  }
  EXPECT_EQ(flight.state(), SafetyState::kNormal);
}

TEST(Supervisor, TiltAndPlaceMeanNothingWithoutAPose) {
  Flight flight;
  flight.blindFor(0.1);
  flight.conditions.tilt = 3.0;
  flight.conditions.distance_from_pad = 50.0;
  flight.blindFor(0.35);
  EXPECT_EQ(flight.state(), SafetyState::kCoasting);
}

TEST(Supervisor, LandsBeyondTheFenceAndCutsFarBeyond) {
  for (const bool upwards : {false, true}) {
    Flight flight;
    double& place = upwards ? flight.conditions.height_above_pad : flight.conditions.distance_from_pad;
    const double fence = upwards ? flight.options.fence_height : flight.options.fence_radius;
    place = fence - 0.01;
    EXPECT_EQ(flight.tick().state, SafetyState::kNormal);
    place = fence + 0.01;
    EXPECT_EQ(flight.tick().state, SafetyState::kLandNow);
    EXPECT_TRUE(raised(flight.memory, Failsafe::kFence));
    place = 0.3;
    EXPECT_EQ(flight.tick().state, SafetyState::kLandNow) << "the order to land stays";
    place = fence + flight.options.hard_fence_margin + 0.01;
    EXPECT_EQ(flight.tick().state, SafetyState::kCut);
    EXPECT_TRUE(raised(flight.memory, Failsafe::kHardFence));
  }
}

TEST(Supervisor, FenceIsForFlightOnly) {
  for (const auto phase : {FlightPhase::kSpinUp, FlightPhase::kLiftOff, FlightPhase::kTouchdown}) {
    Flight flight;
    flight.conditions.phase = phase;
    flight.conditions.distance_from_pad = 50.0;
    flight.conditions.flight_time_s = 1000.0;
    EXPECT_EQ(flight.tick().state, SafetyState::kNormal);
  }
}

TEST(Supervisor, CutsWhenItDoesNotLiftOff) {
  Flight flight;
  flight.conditions.phase = FlightPhase::kLiftOff;
  flight.conditions.lift_off_failed = true;
  EXPECT_EQ(flight.tick().state, SafetyState::kCut);
  EXPECT_TRUE(raised(flight.memory, Failsafe::kLiftOffFailed));
}

TEST(Supervisor, LandsWhenTheFlightTimeIsOver) {
  Flight flight;
  flight.conditions.flight_time_s = flight.options.flight_time_limit_s - 0.1;
  EXPECT_EQ(flight.tick().state, SafetyState::kNormal);
  flight.conditions.flight_time_s += 0.2;
  EXPECT_EQ(flight.tick().state, SafetyState::kLandNow);
  EXPECT_TRUE(raised(flight.memory, Failsafe::kFlightTime));
}

TEST(Supervisor, LandingOrderReturnsAfterADescentThatThePoseEnded) {
  Flight flight;
  flight.conditions.flight_time_s = flight.options.flight_time_limit_s + 1.0;
  flight.tick();
  flight.blindFor(0.8);
  EXPECT_EQ(flight.state(), SafetyState::kDescending);
  flight.conditions.pose_age_s = 0.0;
  flight.tick();
  EXPECT_EQ(flight.tick().state, SafetyState::kLandNow);
}

TEST(Supervisor, KillCutsInEveryPhaseAndState) {
  for (const auto phase :
       {FlightPhase::kIdle, FlightPhase::kSpinUp, FlightPhase::kLiftOff, FlightPhase::kFlying,
        FlightPhase::kLanding, FlightPhase::kTouchdown, FlightPhase::kOff})
    for (const auto state : {SafetyState::kNormal, SafetyState::kCoasting, SafetyState::kDescending,
                             SafetyState::kLandNow, SafetyState::kCut}) {
      Flight flight;
      flight.memory.state = state;
      flight.conditions.phase = phase;
      flight.conditions.kill = true;
      EXPECT_EQ(flight.tick().state, SafetyState::kCut);
      EXPECT_TRUE(raised(flight.memory, Failsafe::kKill));
    }
}

SupervisorConditions randomConditions(Random& random, TimeNs now) {
  SupervisorConditions c;
  c.now = now;
  c.phase = static_cast<FlightPhase>(static_cast<int>(random.uniform(0.0, 7.0)));
  c.pose_age_s = random.uniform() < 0.6 ? random.uniform(0.0, 0.05) : random.uniform(0.0, 3.0);
  c.tilt = random.uniform() < 0.9 ? random.uniform(0.0, 0.5) : random.uniform(0.0, 3.0);
  c.distance_from_pad = random.uniform() < 0.9 ? random.uniform(0.0, 1.5) : random.uniform(0.0, 3.0);
  c.height_above_pad = random.uniform(-0.1, 2.05);
  c.flight_time_s = toSeconds(now);
  c.lift_off_failed = random.uniform() < 0.002;
  c.kill = random.uniform() < 0.002;
  return c;
}

/// Whatever happens, in whatever order.
TEST(Supervisor, KeepsItsPromisesUnderRandomConditions) {
  const SupervisorOptions options;
  Random random(1);
  for (int sequence = 0; sequence < 2000; ++sequence) {
    SupervisorMemory memory;
    TimeNs now = fromSeconds(random.uniform(0.0, 650.0));
    for (int i = 0; i < 300; ++i) {
      now += fromSeconds(kTick);
      const SupervisorConditions c = randomConditions(random, now);
      const SupervisorMemory before = memory;
      memory = supervise(options, before, c);

      ASSERT_EQ(memory.failsafes & before.failsafes, before.failsafes) << "failsafes stay on record";
      if (c.kill) {
        ASSERT_EQ(memory.state, SafetyState::kCut);
      }
      if (before.state == SafetyState::kCut) {
        ASSERT_EQ(memory.state, SafetyState::kCut);
      }
      if (c.kill || before.state == SafetyState::kCut) continue;
      if (c.phase == FlightPhase::kIdle || c.phase == FlightPhase::kOff) {
        ASSERT_EQ(memory.state, before.state) << "with rotors off there is nothing to do";
        ASSERT_EQ(memory.failsafes, before.failsafes);
        continue;
      }
      const bool blind = memory.state == SafetyState::kCoasting || memory.state == SafetyState::kDescending;
      if (c.pose_age_s <= options.coast_after_s) {
        ASSERT_FALSE(blind);
      }
      if (c.pose_age_s > options.descend_after_s) {
        ASSERT_TRUE(memory.state == SafetyState::kDescending || memory.state == SafetyState::kCut);
      }
      if (memory.state == SafetyState::kCut) {
        ASSERT_NE(memory.failsafes, 0u) << "a cut has a reason";
      }
    }
  }
}

/// The same conditions and memory give the same answer: what a session logged can be asked again.
TEST(Supervisor, IsAPureFunction) {
  const SupervisorOptions options;
  Random random(2);
  SupervisorMemory memory;
  for (int i = 0; i < 2000; ++i) {
    const SupervisorConditions c = randomConditions(random, fromSeconds(i * kTick));
    const SupervisorMemory once = supervise(options, memory, c), twice = supervise(options, memory, c);
    EXPECT_EQ(once.state, twice.state);
    EXPECT_EQ(once.failsafes, twice.failsafes);
    EXPECT_EQ(once.tilted_since, twice.tilted_since);
    EXPECT_EQ(once.descending_since, twice.descending_since);
    EXPECT_EQ(once.descent_s, twice.descent_s);
    memory = once;
  }
}

}  // namespace
}  // namespace helical
