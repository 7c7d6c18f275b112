#include "engine/flight/autopilot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/geometry/rotation.h"
#include "engine/helicopter/dynamics.h"

namespace helical {
namespace {

using testing::ElementsAre;

constexpr double kTick = 1.0 / 60.0;
OperatorCommands only(bool OperatorCommands::*order) {
  OperatorCommands commands;
  commands.*order = true;
  return commands;
}
/// Armed in the same tick.
const OperatorCommands kTakeOff = [] {
  OperatorCommands commands = only(&OperatorCommands::take_off);
  commands.arm = true;
  return commands;
}();
const OperatorCommands kLand = only(&OperatorCommands::land);
const OperatorCommands kHold = only(&OperatorCommands::hold);
const OperatorCommands kKill = only(&OperatorCommands::kill);

bool raised(const AutopilotOutput& output, Failsafe failsafe) {
  return (output.failsafes & static_cast<std::uint32_t>(failsafe)) != 0;
}

FlightPlan shortHover() {
  FlightPlan plan;
  plan.land_at_s = 12.0;
  plan.start_delay_s = 0.0;
  return plan;
}

/// The autopilot on the equations of motion in still air, its pose known without error unless `blind`.
struct Flight {
  Autopilot autopilot;
  Dynamics dynamics;
  AutopilotInput input;
  AutopilotOutput output;
  bool blind = false;
  std::vector<FlightPhase> phases{FlightPhase::kIdle};

  explicit Flight(const FlightPlan& plan = shortHover(), const SupervisorOptions& safety = {})
      : autopilot(plan, {}, safety, HelicopterParameters::xrb()), dynamics(HelicopterParameters::xrb()) {
    dynamics.placeOnGround(0.01, -0.01, 0.1);
    input.pose_known = true;
  }

  const AutopilotOutput& tick(const OperatorCommands& commands = {}) {
    input.pose_age_s = blind ? input.pose_age_s + kTick : 0.01;
    if (!blind) input.state = dynamics.state();
    input.commands = commands;
    output = autopilot.step(input);
    const TimeNs next = input.now + fromSeconds(kTick);
    for (; input.now < next; input.now += kNanosecondsPerMillisecond) dynamics.step(output.sticks, {}, 1e-3);
    input.now = next;
    if (output.phase != phases.back()) phases.push_back(output.phase);
    return output;
  }
  void run(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds / kTick); ++i) tick();
  }
  /// Ticks until `phase` begins; false if it does not within half a minute.
  bool runUntil(FlightPhase phase) {
    for (int i = 0; i < 1800 && output.phase != phase; ++i) tick();
    return output.phase == phase;
  }
  double height() const {
    return dynamics.state().world_from_body.translation.z() - dynamics.parameters().standing_height;
  }
};

TEST(Autopilot, FliesThePlanFromPadToPad) {
  Flight flight;
  flight.tick(kTakeOff);
  double highest = 0.0;
  while (flight.output.phase != FlightPhase::kOff && flight.input.now < 30 * kNanosecondsPerSecond) {
    flight.tick();
    highest = std::max(highest, flight.height());
    if (flight.output.hovering) {
      EXPECT_NEAR(flight.height(), 0.6, 0.15);
    }
    EXPECT_EQ(flight.output.airborne,
              flight.output.phase == FlightPhase::kFlying || flight.output.phase == FlightPhase::kLanding);
  }
  EXPECT_THAT(flight.phases, ElementsAre(FlightPhase::kIdle, FlightPhase::kSpinUp, FlightPhase::kLiftOff,
                                         FlightPhase::kFlying, FlightPhase::kLanding, FlightPhase::kTouchdown,
                                         FlightPhase::kOff));
  EXPECT_NEAR(highest, 0.6, 0.1);
  EXPECT_LT(flight.dynamics.hardestTouch(), 0.3);
  EXPECT_EQ(flight.output.safety, SafetyState::kNormal);
  EXPECT_EQ(flight.output.failsafes, 0u);
  EXPECT_EQ(flight.tick().sticks, StickDemand{});
}

TEST(Autopilot, RestsUntilItIsToldToTakeOff) {
  Flight flight;
  for (int i = 0; i < 300; ++i) {
    flight.tick();
    EXPECT_EQ(flight.output.phase, FlightPhase::kIdle);
    EXPECT_EQ(flight.output.sticks, StickDemand{});
  }
}

TEST(Autopilot, TakesOffOnlyWhenItIsArmed) {
  Flight flight;
  flight.tick(only(&OperatorCommands::take_off));
  EXPECT_STREQ(flight.output.refusal, "it is not armed");
  flight.tick(only(&OperatorCommands::arm));
  EXPECT_TRUE(flight.output.armed);
  EXPECT_EQ(flight.output.arm_refused, 0u);
  flight.run(2.0);
  EXPECT_EQ(flight.output.phase, FlightPhase::kIdle) << "the order that was refused is not kept";
  flight.tick(only(&OperatorCommands::disarm));
  EXPECT_FALSE(flight.output.armed);
  flight.tick(only(&OperatorCommands::take_off));
  EXPECT_STREQ(flight.output.refusal, "it is not armed");
  flight.tick(kTakeOff);
  EXPECT_EQ(flight.output.phase, FlightPhase::kSpinUp);
}

TEST(Autopilot, DoesNotArmBeforeThePoseIsKnown) {
  Flight flight;
  flight.input.pose_known = false;
  flight.tick(kTakeOff);
  EXPECT_FALSE(flight.output.armed);
  EXPECT_NE(flight.output.arm_refused & bitOf(PreArmCheck::kPose), 0u);
  EXPECT_STREQ(flight.output.refusal, "the helicopter is not seen");
  flight.input.pose_known = true;
  flight.run(2.0);
  EXPECT_EQ(flight.output.phase, FlightPhase::kIdle);
}

TEST(Autopilot, LandTakesAWaitingTakeOffBack) {
  FlightPlan plan = shortHover();
  plan.start_delay_s = 3.0;
  Flight flight(plan);
  flight.tick(kTakeOff);
  flight.tick(kLand);
  flight.run(5.0);
  EXPECT_EQ(flight.output.phase, FlightPhase::kIdle);
}

TEST(Autopilot, HoldsWhereItIsUntilItIsToldToGoOn) {
  FlightPlan plan;
  plan.land_at_s = 0.0;
  plan.waypoints = {{{0, 0, 0.4}, 0.0, 0.0, 0.3}, {{0.6, 0, 0.4}, 0.0, 0.5, 0.2}};
  Flight flight(plan);
  flight.tick(kTakeOff);
  ASSERT_TRUE(flight.runUntil(FlightPhase::kFlying));
  while (flight.output.set_point.position_in_world.x() < 0.2) flight.tick();
  flight.tick(kHold);
  EXPECT_TRUE(flight.output.holding);
  flight.run(15.0);
  EXPECT_EQ(flight.output.phase, FlightPhase::kFlying);
  EXPECT_NEAR(flight.dynamics.state().world_from_body.translation.x(), 0.2, 0.05);
  flight.tick(only(&OperatorCommands::take_off));
  EXPECT_FALSE(flight.output.holding);
  ASSERT_TRUE(flight.runUntil(FlightPhase::kOff));
  EXPECT_NEAR(flight.dynamics.state().world_from_body.translation.x(), 0.6, 0.1);
}

TEST(Autopilot, DoesNotStartOnAnOldPose) {
  FlightPlan plan = shortHover();
  plan.start_delay_s = 1.0;
  Flight flight(plan);
  flight.run(0.1);
  flight.tick(kTakeOff);
  EXPECT_TRUE(flight.output.armed);
  flight.blind = true;
  std::string refusal;
  for (int i = 0; i < 120; ++i)
    if (flight.tick().refusal != nullptr) refusal = flight.output.refusal;
  EXPECT_FALSE(flight.output.armed);
  EXPECT_EQ(refusal, "the helicopter is not seen");
  flight.blind = false;
  flight.run(3.0);
  EXPECT_EQ(flight.output.phase, FlightPhase::kIdle) << "and does not when it comes back";
}

TEST(Autopilot, MeasuresThePadBeforeTheStart) {
  Flight flight;
  flight.blind = true;  // states come from here alone
  flight.input.state.world_from_body.translation.z() = 0.071;
  flight.input.pose_age_s = -1.0;
  flight.tick();
  EXPECT_NEAR(flight.output.pad_height, 0.071, 1e-9);
}

TEST(Autopilot, WaitsTheDelayOfThePlanFromWhenItIsFirstSeen) {
  FlightPlan plan = shortHover();
  plan.start_delay_s = 3.0;
  Flight flight(plan);
  flight.tick(kTakeOff);
  flight.run(2.8);
  EXPECT_EQ(flight.output.phase, FlightPhase::kIdle);
  flight.run(0.4);
  EXPECT_EQ(flight.output.phase, FlightPhase::kSpinUp);
}

TEST(Autopilot, StartsOnlyStandingStillAndUprightOnThePad) {
  struct Case {
    const char* refusal;
    void (*disturb)(HelicopterState&);
  };
  const Case cases[] = {
      {"it does not stand on the pad", [](HelicopterState& s) { s.world_from_body.translation.x() = 0.8; }},
      {"it does not stand on the pad", [](HelicopterState& s) { s.world_from_body.translation.z() = 1.1; }},
      {"it does not stand upright",
       [](HelicopterState& s) {
         s.world_from_body.rotation = expSO3({0.5, 0, 0});
       }},
      {"it moves", [](HelicopterState& s) { s.velocity_in_world.x() = 0.4; }}};
  for (const Case& c : cases) {
    Flight flight;
    flight.tick();
    c.disturb(flight.input.state);
    flight.blind = true;  // states come from here alone
    std::string refusal;
    for (int i = 0; i < 400; ++i) {
      flight.input.pose_age_s = -1.0;
      if (flight.tick(i == 0 ? kTakeOff : OperatorCommands{}).refusal != nullptr)
        refusal = flight.output.refusal;
      EXPECT_EQ(flight.output.phase, FlightPhase::kIdle);
    }
    EXPECT_EQ(refusal, c.refusal);
  }
}

TEST(Autopilot, LandDuringSpinUpAndLiftOffStopsTheRotorsOnThePad) {
  for (const auto phase : {FlightPhase::kSpinUp, FlightPhase::kLiftOff}) {
    Flight flight;
    flight.tick(kTakeOff);
    ASSERT_TRUE(flight.runUntil(phase));
    flight.tick(kLand);
    EXPECT_EQ(flight.output.phase, FlightPhase::kTouchdown);
    flight.run(3.0);
    EXPECT_EQ(flight.output.phase, FlightPhase::kOff);
    EXPECT_LT(flight.height(), 0.02);
    EXPECT_EQ(flight.output.sticks, StickDemand{});
  }
}

TEST(Autopilot, LandsWhenTold) {
  Flight flight;
  flight.tick(kTakeOff);
  ASSERT_TRUE(flight.runUntil(FlightPhase::kFlying));
  flight.run(1.5);
  flight.tick(kLand);
  EXPECT_EQ(flight.output.phase, FlightPhase::kLanding);
  ASSERT_TRUE(flight.runUntil(FlightPhase::kOff));
  EXPECT_LT(flight.height(), 0.02);
  EXPECT_LT(flight.dynamics.hardestTouch(), 0.3);
}

TEST(Autopilot, LandsAfterTheLastWaypointWhenThePlanHasNoTime) {
  FlightPlan plan;
  plan.land_at_s = 0.0;
  plan.waypoints = {{{0, 0, 0.4}, 0.0, 0.5, 0.3}, {{0.2, 0.1, 0.5}, 0.3, 0.5, 0.3}};
  Flight flight(plan);
  flight.tick(kTakeOff);
  ASSERT_TRUE(flight.runUntil(FlightPhase::kLanding));
  EXPECT_NEAR(flight.dynamics.state().world_from_body.translation.x(), 0.2, 0.1);
  ASSERT_TRUE(flight.runUntil(FlightPhase::kOff));
}

TEST(Autopilot, KillStopsTheRotorsAtOnceInEveryPhaseAndForGood) {
  for (const auto phase :
       {FlightPhase::kIdle, FlightPhase::kSpinUp, FlightPhase::kLiftOff, FlightPhase::kFlying,
        FlightPhase::kLanding, FlightPhase::kTouchdown, FlightPhase::kOff}) {
    Flight flight;
    if (phase != FlightPhase::kIdle) flight.tick(kTakeOff);
    ASSERT_TRUE(flight.runUntil(phase));
    flight.tick(kKill);
    for (int i = 0; i < 300; ++i) {
      EXPECT_EQ(flight.output.sticks, StickDemand{});
      EXPECT_EQ(flight.output.safety, SafetyState::kCut);
      EXPECT_TRUE(raised(flight.output, Failsafe::kKill));
      EXPECT_FALSE(flight.output.airborne);
      flight.tick(kTakeOff);
    }
  }
}

TEST(Autopilot, KillWinsOverTakeOffInTheSameTick) {
  Flight flight;
  OperatorCommands both = kTakeOff;
  both.kill = true;
  flight.tick(both);
  flight.run(2.0);
  EXPECT_EQ(flight.output.phase, FlightPhase::kIdle);
  EXPECT_EQ(flight.output.safety, SafetyState::kCut);
}

TEST(Autopilot, FliesOnAfterAShortGap) {
  Flight flight;
  flight.tick(kTakeOff);
  ASSERT_TRUE(flight.runUntil(FlightPhase::kFlying));
  flight.run(4.0);
  flight.blind = true;
  flight.run(0.3);
  EXPECT_EQ(flight.output.safety, SafetyState::kNeutral);
  EXPECT_EQ(flight.output.phase, FlightPhase::kFlying);
  flight.blind = false;
  flight.tick();
  EXPECT_EQ(flight.output.safety, SafetyState::kNormal);
  EXPECT_LT(
      (flight.output.set_point.position_in_world - flight.input.state.world_from_body.translation).norm(),
      0.02)
      << "from where it is, without racing back";
  ASSERT_TRUE(flight.runUntil(FlightPhase::kOff));
  EXPECT_LT(flight.dynamics.hardestTouch(), 0.3);
}

TEST(Autopilot, BlindDescentEndsSoftlyAndInCut) {
  Flight flight;
  flight.tick(kTakeOff);
  ASSERT_TRUE(flight.runUntil(FlightPhase::kFlying));
  flight.run(4.0);
  flight.blind = true;
  flight.run(0.8);
  EXPECT_EQ(flight.output.safety, SafetyState::kDescending);
  flight.run(7.0);
  EXPECT_EQ(flight.output.safety, SafetyState::kCut);
  EXPECT_EQ(flight.output.phase, FlightPhase::kOff);
  EXPECT_EQ(flight.output.sticks, StickDemand{});
  EXPECT_TRUE(raised(flight.output, Failsafe::kNoPoseDescent));
  EXPECT_TRUE(raised(flight.output, Failsafe::kNoPoseCut));
  flight.run(1.0);
  EXPECT_LT(flight.height(), 0.02);
  EXPECT_LT(flight.dynamics.hardestTouch(), 1.0);
  flight.blind = false;
  flight.tick(kTakeOff);
  flight.run(2.0);
  EXPECT_EQ(flight.output.phase, FlightPhase::kOff) << "a cut is for good";
}

TEST(Autopilot, DoesNotLeaveTheGroundOnOneCamera) {
  for (const auto phase : {FlightPhase::kSpinUp, FlightPhase::kLiftOff}) {
    Flight flight;
    flight.tick(kTakeOff);
    ASSERT_TRUE(flight.runUntil(phase));
    flight.input.health.live_cameras = 1;
    flight.run(0.1);
    EXPECT_EQ(flight.output.phase, phase) << "for a moment it may";
    std::string refusal;
    for (int i = 0; i < 200; ++i)
      if (flight.tick().refusal != nullptr) refusal = flight.output.refusal;
    EXPECT_EQ(flight.output.phase, FlightPhase::kOff);
    EXPECT_EQ(refusal, toString(PreArmCheck::kCameras));
    EXPECT_LT(flight.height(), 0.02);
  }
}

TEST(Autopilot, APoseThatMovesBeforeTheRotorsCarryItIsCut) {
  Flight flight;
  flight.tick(kTakeOff);
  ASSERT_TRUE(flight.runUntil(FlightPhase::kSpinUp));
  flight.run(0.3);
  flight.blind = true;  // states come from here alone
  flight.input.pose_age_s = -1.0;
  flight.input.state.world_from_body.translation += Eigen::Vector3d(0.1, 0.0, 0.2);
  flight.tick();
  EXPECT_EQ(flight.output.safety, SafetyState::kCut);
  EXPECT_TRUE(raised(flight.output, Failsafe::kLiftOffFailed));
  EXPECT_EQ(flight.output.sticks, StickDemand{});
}

TEST(Autopilot, BlindInTheClimbItComesDownSoftly) {
  for (const double after : {0.2, 0.5, 1.0, 1.5}) {
    Flight flight;
    flight.tick(kTakeOff);
    ASSERT_TRUE(flight.runUntil(FlightPhase::kFlying));
    flight.run(after);
    flight.blind = true;
    double highest = 0.0;
    while (flight.output.phase != FlightPhase::kOff && flight.input.now < 40 * kNanosecondsPerSecond) {
      // What a tracker foretells: it goes on as it went.
      if (flight.input.pose_age_s < 0.6)
        flight.input.state.world_from_body.translation += kTick * flight.input.state.velocity_in_world;
      flight.tick();
      highest = std::max(highest, flight.height());
    }
    flight.run(1.0);
    EXPECT_LT(flight.height(), 0.02) << after;
    EXPECT_LT(flight.dynamics.hardestTouch(), 1.0) << after;
    EXPECT_LT(highest, 1.2) << after << ": it does not climb on";
  }
}

TEST(Autopilot, DoesNotOpenTheThrottleOfALiftOffThatNobodySees) {
  Flight flight;
  flight.tick(kTakeOff);
  ASSERT_TRUE(flight.runUntil(FlightPhase::kLiftOff));
  flight.blind = true;
  flight.run(0.1);
  const StickDemand before = flight.output.sticks;
  flight.run(0.3);
  EXPECT_LE(flight.output.sticks.lower_rotor + flight.output.sticks.upper_rotor,
            before.lower_rotor + before.upper_rotor + 1e-3);
  flight.blind = false;
  EXPECT_TRUE(flight.runUntil(FlightPhase::kFlying));
}

TEST(Autopilot, GivesUpALiftOffThatDoesNotLift) {
  Flight flight;
  flight.tick(kTakeOff);
  const HelicopterState standing = flight.input.state;
  double highest_throttle = 0.0;
  for (int i = 0; i < 1200 && flight.output.safety != SafetyState::kCut; ++i) {
    flight.dynamics.placeOnGround(standing.world_from_body.translation.x(), 0.0, 0.1);
    flight.tick();
    highest_throttle = std::max(highest_throttle, flight.output.sticks.upper_rotor);
  }
  EXPECT_EQ(flight.output.safety, SafetyState::kCut);
  EXPECT_TRUE(raised(flight.output, Failsafe::kLiftOffFailed));
  EXPECT_GT(highest_throttle, 1.5 * HelicopterParameters::xrb().hoverStickUpper());
}

TEST(Autopilot, IsPushedBackFromTheFenceWhereverThePlanLeads) {
  FlightPlan plan;
  plan.waypoints = {{{0, 0, 0.4}, 0.0, 0.0, 0.3}, {{0.8, 0, 0.4}, 0.0, 3.0, 0.3}};
  plan.land_at_s = 25.0;
  SupervisorOptions safety;
  safety.fence_radius = 0.5;
  Flight flight(plan, safety);
  flight.tick(kTakeOff);
  double farthest = 0.0;
  for (int i = 0; i < 1440; ++i) farthest = std::max(farthest, flight.tick().set_point.position_in_world.x());
  EXPECT_GT(farthest, 0.7) << "the plan goes on";
  EXPECT_NEAR(flight.dynamics.state().world_from_body.translation.x(), 0.3, 0.05);
  ASSERT_TRUE(flight.runUntil(FlightPhase::kOff));
  EXPECT_EQ(flight.output.failsafes, 0u);
}

TEST(Autopilot, LandsBeyondTheFence) {
  Flight flight;
  flight.tick(kTakeOff);
  ASSERT_TRUE(flight.runUntil(FlightPhase::kFlying));
  flight.run(1.0);
  flight.blind = true;  // states come from here alone
  flight.input.pose_age_s = -1.0;
  flight.input.state.world_from_body.translation.x() = 1.6;
  flight.tick();
  EXPECT_EQ(flight.output.phase, FlightPhase::kLanding);
  EXPECT_TRUE(raised(flight.output, Failsafe::kFence));
  EXPECT_FALSE(raised(flight.output, Failsafe::kHardFence));
}

}  // namespace
}  // namespace helical
