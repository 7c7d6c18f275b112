#include "engine/flight/supervisor.h"

#include <gtest/gtest.h>

#include "tests/flight/supervised_flight.h"

namespace helical {
namespace {

using test::kTick;
using test::raised;
using test::SupervisedFlight;

TEST(Supervisor, LeavesAQuietFlightAlone) {
  SupervisedFlight flight;
  for (int i = 0; i < 600; ++i) flight.tick();
  EXPECT_EQ(flight.state(), SafetyState::kNormal);
  EXPECT_EQ(flight.memory.failsafes, 0u);
  EXPECT_EQ(flight.memory.alarms, 0u);
}

TEST(Supervisor, CoastsThenGoesNeutralWithoutAPoseAndRecoversAtOnce) {
  SupervisedFlight flight;
  flight.blindFor(0.05);
  EXPECT_EQ(flight.state(), SafetyState::kNormal);
  flight.blindFor(0.02);
  EXPECT_EQ(flight.state(), SafetyState::kCoasting);
  EXPECT_TRUE(raised(flight.memory, Failsafe::kNoPoseCoast));
  flight.blindFor(0.1);
  EXPECT_EQ(flight.state(), SafetyState::kNeutral);
  EXPECT_TRUE(raised(flight.memory, Failsafe::kNoPoseNeutral));
  flight.conditions.pose_age_s = 0.0;
  EXPECT_EQ(flight.tick().state, SafetyState::kNormal);
  EXPECT_TRUE(raised(flight.memory, Failsafe::kNoPoseCoast)) << "what happened stays on record";
  EXPECT_EQ(flight.memory.alarms, 0u) << "and is over";
}

TEST(Supervisor, DescendsWithoutPoseForLongAndRecoversAtOnce) {
  SupervisedFlight flight;
  flight.blindFor(0.5);
  EXPECT_EQ(flight.state(), SafetyState::kNeutral);
  flight.blindFor(0.1);
  EXPECT_EQ(flight.state(), SafetyState::kDescending);
  EXPECT_TRUE(raised(flight.memory, Failsafe::kNoPoseDescent));
  flight.conditions.pose_age_s = 0.01;
  EXPECT_EQ(flight.tick().state, SafetyState::kNormal);
  EXPECT_LT(flight.memory.descending_since, 0);
}

TEST(Supervisor, CutsWhenTheDescentIsOver) {
  for (const double height : {0.2, 0.6, 1.5}) {
    SupervisedFlight flight;
    flight.conditions.place.z() = height;
    flight.blindFor(0.5 + 2 * kTick);
    ASSERT_EQ(flight.state(), SafetyState::kDescending);
    const double down = height / flight.options.descent_speed + kSettleOnSkids;
    EXPECT_NEAR(flight.memory.descent_s, down, 1e-9);
    // Where it believes to be now means nothing: the time was fixed when the descent began.
    flight.conditions.place.z() = 40.0;
    flight.blindFor(down - 3 * kTick);
    EXPECT_EQ(flight.state(), SafetyState::kDescending);
    flight.blindFor(5 * kTick);
    EXPECT_EQ(flight.state(), SafetyState::kCut);
    EXPECT_TRUE(raised(flight.memory, Failsafe::kNoPoseCut));
  }
}

TEST(Supervisor, ADescentThatBeginsInAClimbIsTimedFromItsApex) {
  SupervisedFlight flight;
  flight.conditions.climb = 0.4;
  flight.blindFor(0.5 + 2 * kTick);
  ASSERT_EQ(flight.state(), SafetyState::kDescending);
  const double to_apex_s = 0.4 / kDescentAcceleration, apex = 0.6 + 0.5 * 0.4 * to_apex_s;
  EXPECT_NEAR(flight.memory.descent_s, to_apex_s + apex / flight.options.descent_speed + kSettleOnSkids, 1e-9);
  EXPECT_NEAR(flight.memory.sink_s, to_apex_s + flight.options.descent_speed / kDescentAcceleration, 1e-9);
}

TEST(Supervisor, ADescentThatBeginsInAFallIsBrakedAndNotLonger) {
  SupervisedFlight flight;
  flight.conditions.climb = -0.9;
  flight.blindFor(0.5 + 2 * kTick);
  EXPECT_NEAR(flight.memory.descent_s, 0.6 / flight.options.descent_speed + kSettleOnSkids, 1e-9);
  EXPECT_NEAR(flight.memory.sink_s, -0.4 / kDescentAcceleration, 1e-9);
}

TEST(Supervisor, SaysThatThereIsNoPoseBeforeItsLimitPasses) {
  SupervisedFlight flight;
  flight.conditions.period_s = kTick;
  flight.conditions.pose_age_s = flight.options.coast_after_s - kTick - 0.001;
  EXPECT_EQ(flight.tick().alarms, 0u);
  flight.conditions.pose_age_s = flight.options.coast_after_s - kTick + 0.001;
  EXPECT_EQ(flight.tick().alarms, bitOf(Failsafe::kNoPoseCoast));
}

TEST(Supervisor, DescentIsNeverLongerThanItsLimit) {
  SupervisedFlight flight;
  flight.blindFor(0.1);
  flight.conditions.place.z() = 100.0;
  flight.blindFor(0.4 + flight.options.longest_descent_s - 2 * kTick);
  EXPECT_EQ(flight.state(), SafetyState::kDescending);
  flight.blindFor(5 * kTick);
  EXPECT_EQ(flight.state(), SafetyState::kCut);
}

TEST(Supervisor, EveryDescentHasItsOwnTime) {
  SupervisedFlight flight;
  flight.blindFor(1.0);
  ASSERT_EQ(flight.state(), SafetyState::kDescending);
  flight.conditions.pose_age_s = 0.0;
  flight.tick();
  flight.blindFor(0.5 + flight.memory.descent_s - 0.2);
  EXPECT_EQ(flight.state(), SafetyState::kDescending);
}

TEST(Supervisor, CutsWhenTiltedForLong) {
  SupervisedFlight flight;
  flight.conditions.tilt = 1.05;
  for (int i = 0; i < 18; ++i) flight.tick();
  EXPECT_EQ(flight.state(), SafetyState::kNormal);
  for (int i = 0; i < 3; ++i) flight.tick();
  EXPECT_EQ(flight.state(), SafetyState::kCut);
  EXPECT_TRUE(raised(flight.memory, Failsafe::kTilt));
}

TEST(Supervisor, TiltThatEndsStartsItsTimeAnew) {
  SupervisedFlight flight;
  for (int swing = 0; swing < 10; ++swing) {
    flight.conditions.tilt = 1.2;
    for (int i = 0; i < 15; ++i) flight.tick();
    flight.conditions.tilt = 0.9;
    flight.tick();
  }
  EXPECT_EQ(flight.state(), SafetyState::kNormal);
}

TEST(Supervisor, TiltPlaceAndSpeedMeanNothingWithoutAPose) {
  SupervisedFlight flight;
  flight.blindFor(0.1);
  flight.conditions.tilt = 3.0;
  flight.conditions.speed = 30.0;
  flight.conditions.place.x() = 50.0;
  flight.blindFor(0.35);
  EXPECT_EQ(flight.state(), SafetyState::kNeutral);
}

TEST(Supervisor, WarnsNearTheFenceLandsBeyondItAndCutsFarBeyond) {
  for (const FenceShape shape : {FenceShape::kCylinder, FenceShape::kBox})
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {-1.0, 1.0}) {
        if (axis == 2 && side < 0.0) continue;  // the ground is no fence
        SupervisedFlight flight;
        flight.options.fence = shape;
        flight.options.fence_half_y = 1.2;
        const double reach = axis == 2                                ? flight.options.fence_height
                             : axis == 1 && shape == FenceShape::kBox ? flight.options.fence_half_y
                                                                      : flight.options.fence_radius;
        double& place = flight.conditions.place[axis];
        place = side * (reach - flight.options.fence_warning_margin - 0.01);
        EXPECT_EQ(flight.tick().alarms, 0u);
        place = side * (reach - 0.01);
        EXPECT_EQ(flight.tick().state, SafetyState::kNormal);
        EXPECT_EQ(flight.memory.alarms, bitOf(Failsafe::kFenceNear));
        place = side * (reach + 0.01);
        EXPECT_EQ(flight.tick().state, SafetyState::kLandNow);
        EXPECT_TRUE(raised(flight.memory, Failsafe::kFence));
        place = 0.3;
        EXPECT_EQ(flight.tick().state, SafetyState::kLandNow) << "the order to land stays";
        place = side * (reach + flight.options.hard_fence_margin + 0.01);
        EXPECT_EQ(flight.tick().state, SafetyState::kCut);
        EXPECT_TRUE(raised(flight.memory, Failsafe::kHardFence));
      }
}

TEST(Supervisor, FenceAndFlightTimeAreForFlightOnly) {
  for (const auto phase : {FlightPhase::kSpinUp, FlightPhase::kLiftOff, FlightPhase::kTouchdown}) {
    SupervisedFlight flight;
    flight.conditions.phase = phase;
    flight.conditions.place.x() = 50.0;
    flight.conditions.flight_time_s = 1000.0;
    EXPECT_EQ(flight.tick().state, SafetyState::kNormal);
  }
}

TEST(Supervisor, LandsWhenItIsTooFastForLong) {
  SupervisedFlight flight;
  flight.conditions.speed = flight.options.speed_limit + 0.1;
  for (int i = 0; i < 18; ++i) flight.tick();
  EXPECT_EQ(flight.state(), SafetyState::kNormal);
  for (int i = 0; i < 3; ++i) flight.tick();
  EXPECT_EQ(flight.state(), SafetyState::kLandNow);
}

TEST(Supervisor, CutsWhenItDoesNotLiftOff) {
  SupervisedFlight flight;
  flight.conditions.phase = FlightPhase::kLiftOff;
  flight.conditions.lift_off_failed = true;
  EXPECT_EQ(flight.tick().state, SafetyState::kCut);
  EXPECT_TRUE(raised(flight.memory, Failsafe::kLiftOffFailed));
}

TEST(Supervisor, WarnsThenLandsWhenTheFlightTimeIsOver) {
  SupervisedFlight flight;
  flight.conditions.flight_time_s = 0.9 * flight.options.flight_time_limit_s - 0.1;
  EXPECT_EQ(flight.tick().alarms, 0u);
  flight.conditions.flight_time_s += 0.2;
  EXPECT_EQ(flight.tick().alarms, bitOf(Failsafe::kFlightTimeSoon));
  EXPECT_EQ(flight.memory.failsafes, 0u) << "a warning is no failsafe";
  flight.conditions.flight_time_s = flight.options.flight_time_limit_s + 0.1;
  EXPECT_EQ(flight.tick().state, SafetyState::kLandNow);
  EXPECT_TRUE(raised(flight.memory, Failsafe::kFlightTime));
}

TEST(Supervisor, ADoubtfulPoseHoldsThenLandsAndClearsOnlyWellBelowItsLimit) {
  const auto flight_with = [](auto&& doubt) {
    SupervisedFlight flight;
    doubt(flight.conditions.health, 1.01);
    for (int i = 0; i < 29; ++i) flight.tick();
    EXPECT_EQ(flight.state(), SafetyState::kNormal);
    for (int i = 0; i < 3; ++i) flight.tick();
    EXPECT_EQ(flight.state(), SafetyState::kHolding);
    doubt(flight.conditions.health, 0.5);
    flight.tick();
    EXPECT_EQ(flight.state(), SafetyState::kHolding) << "it is still above 1/2.5 of the limit";
    doubt(flight.conditions.health, 0.39);
    flight.tick();
    EXPECT_EQ(flight.state(), SafetyState::kNormal);
    doubt(flight.conditions.health, 1.01);
    for (int i = 0; i < 94; ++i) flight.tick();
    EXPECT_EQ(flight.state(), SafetyState::kLandNow);
    EXPECT_TRUE(raised(flight.memory, Failsafe::kUncertainLand));
  };
  const SupervisorOptions o;
  flight_with([&](SystemHealth& h, double share) { h.residual_ratio = share * o.residual_limit; });
  flight_with([&](SystemHealth& h, double share) { h.position_sigma = share * o.position_sigma_limit; });
  flight_with([&](SystemHealth& h, double share) { h.rotation_sigma = share * o.rotation_sigma_limit; });
}

TEST(Supervisor, WithoutACalibratedCameraItIsAsWithoutAPose) {
  SupervisedFlight flight;
  flight.conditions.health.live_cameras = 0;
  for (int i = 0; i < 9; ++i) flight.tick();
  EXPECT_EQ(flight.state(), SafetyState::kNormal);
  for (int i = 0; i < 2; ++i) flight.tick();
  EXPECT_EQ(flight.state(), SafetyState::kNeutral);
  flight.conditions.health.live_cameras = 1;
  EXPECT_EQ(flight.tick().state, SafetyState::kNormal);
}

TEST(Supervisor, ATransmitterThatIsGoneIsAnAlarmAtOnceAndACutForGoodAfterItsTime) {
  SupervisedFlight flight;
  flight.conditions.health.transmitter_ready = false;
  flight.conditions.health.transmitter_fault = true;
  EXPECT_EQ(flight.tick().alarms, bitOf(Failsafe::kTransmitterFault));
  EXPECT_EQ(flight.state(), SafetyState::kNormal);
  flight.conditions.health.transmitter_ready = true;
  flight.conditions.health.transmitter_fault = false;
  EXPECT_EQ(flight.tick().alarms, 0u);
  flight.conditions.health.transmitter_ready = false;
  flight.conditions.health.transmitter_fault = true;
  for (int i = 0; i < 9; ++i) flight.tick();
  EXPECT_EQ(flight.state(), SafetyState::kCut);
  flight.conditions.health.transmitter_ready = true;  // plugged in again
  flight.conditions.health.transmitter_fault = false;
  flight.conditions.arm = true;
  for (int i = 0; i < 100; ++i) EXPECT_EQ(flight.tick().state, SafetyState::kCut);
}

TEST(Supervisor, ATransmitterThatIsThereAndTakesNothingIsLandedOnAndCutForGoodIfItStaysSo) {
  SupervisedFlight flight;
  flight.conditions.health.transmitter_fault = true;
  EXPECT_EQ(flight.tick().alarms, bitOf(Failsafe::kTransmitterFault));
  for (int i = 0; i < 5; ++i) EXPECT_EQ(flight.tick().state, SafetyState::kNormal);
  flight.tick();
  EXPECT_EQ(flight.tick().state, SafetyState::kLandNow);
  flight.conditions.health.transmitter_fault = false;
  for (int i = 0; i < 100; ++i) EXPECT_EQ(flight.tick().state, SafetyState::kLandNow) << "whatever it does since";
  flight.conditions.health.transmitter_fault = true;
  for (int i = 0; i < 29; ++i) EXPECT_EQ(flight.tick().state, SafetyState::kLandNow);
  for (int i = 0; i < 4; ++i) flight.tick();
  EXPECT_EQ(flight.state(), SafetyState::kCut);
  flight.conditions.health.transmitter_fault = false;
  flight.conditions.arm = true;
  for (int i = 0; i < 100; ++i) EXPECT_EQ(flight.tick().state, SafetyState::kCut);
}

TEST(Supervisor, ThreeLateTicksInARowWarn) {
  SupervisedFlight flight;
  const auto tick_late = [&](bool late) {
    flight.conditions.health.overrun_s = late ? 0.011 : 0.0;
    return flight.tick().alarms;
  };
  EXPECT_EQ(tick_late(true), 0u);
  EXPECT_EQ(tick_late(true), 0u);
  EXPECT_EQ(tick_late(false), 0u);
  EXPECT_EQ(tick_late(true), 0u);
  EXPECT_EQ(tick_late(true), 0u);
  EXPECT_EQ(tick_late(true), bitOf(Failsafe::kOverrun));
  EXPECT_EQ(tick_late(false), 0u);
}

TEST(Supervisor, LandingOrderReturnsAfterADescentThatThePoseEnded) {
  SupervisedFlight flight;
  flight.conditions.flight_time_s = flight.options.flight_time_limit_s + 1.0;
  flight.tick();
  flight.blindFor(0.8);
  EXPECT_EQ(flight.state(), SafetyState::kDescending);
  flight.conditions.pose_age_s = 0.0;
  EXPECT_EQ(flight.tick().state, SafetyState::kLandNow);
}

TEST(Supervisor, KillCutsInEveryPhaseAndState) {
  for (const auto phase : test::kPhases)
    for (int state = 0; state <= static_cast<int>(SafetyState::kCut); ++state) {
      SupervisedFlight flight;
      flight.memory.state = static_cast<SafetyState>(state);
      flight.conditions.phase = phase;
      flight.conditions.kill = true;
      EXPECT_EQ(flight.tick().state, SafetyState::kCut);
      EXPECT_TRUE(raised(flight.memory, Failsafe::kKill));
    }
}

TEST(Supervisor, IsDisarmedFiveSecondsAfterTheCut) {
  SupervisedFlight flight;
  flight.memory.armed = true;
  flight.conditions.kill = true;
  flight.tick();
  flight.conditions.kill = false;
  for (int i = 0; i < 298; ++i) EXPECT_TRUE(flight.tick().armed);
  for (int i = 0; i < 5; ++i) flight.tick();
  EXPECT_FALSE(flight.memory.armed);
}

}  // namespace
}  // namespace helical
