// What holds whatever happens, in whatever order.

#include <gtest/gtest.h>

#include "engine/flight/pre_arm.h"
#include "tests/flight/supervised_flight.h"

namespace helical {
namespace {

using test::kTick;
using test::randomConditions;

TEST(SupervisorProperties, HoldUnderRandomConditions) {
  const SupervisorOptions options;
  Random random(1);
  int armings = 0;
  for (int sequence = 0; sequence < 2000; ++sequence) {
    SupervisorMemory memory;
    TimeNs now = fromSeconds(random.uniform(0.0, 650.0));
    for (int i = 0; i < 300; ++i) {
      now += fromSeconds(kTick);
      const SupervisorConditions c = randomConditions(random, now);
      const SupervisorMemory before = memory;
      memory = supervise(options, before, c);

      ASSERT_EQ(memory.failsafes & before.failsafes, before.failsafes) << "failsafes stay on record";
      if (c.kill || before.state == SafetyState::kCut) {
        ASSERT_EQ(memory.state, SafetyState::kCut) << "kill always wins, a cut stays";
      }
      if (memory.state == SafetyState::kCut) {
        ASSERT_NE(memory.failsafes, 0u) << "a cut has a reason";
      }
      if (memory.armed && !before.armed) {
        ++armings;
        ASSERT_TRUE(c.arm) << "only by an order";
        ASSERT_EQ(failingChecks(options, memory.state, c), 0u) << "and with every check passed";
        ASSERT_NE(memory.state, SafetyState::kCut);
      }
      if (c.arm && !c.disarm && !before.armed && !memory.armed) {
        ASSERT_EQ(memory.refused, failingChecks(options, memory.state, c)) << "all reasons are told";
        ASSERT_NE(memory.refused, 0u);
      }
      if (memory.state == SafetyState::kCut || !rotorsTurn(c.phase)) continue;
      const bool blind = memory.state >= SafetyState::kCoasting;
      if (c.pose_age_s <= options.coast_after_s && c.health.live_cameras > 0) {
        ASSERT_FALSE(blind);
      }
      if (c.pose_age_s > options.descend_after_s) {
        ASSERT_EQ(memory.state, SafetyState::kDescending);
      }
    }
  }
  EXPECT_GT(armings, 100) << "or nothing was tested";
}

/// From conditions that arm, each single thing that must be so.
TEST(SupervisorProperties, NothingArmsWithoutEveryCheck) {
  const auto good = [] {
    SupervisorConditions c;
    c.arm = true;
    return c;
  };
  const SupervisorOptions options;
  ASSERT_TRUE(supervise(options, {}, good()).armed);
  const struct {
    PreArmCheck check;
    void (*spoil)(SupervisorConditions&);
  } cases[] = {
      {PreArmCheck::kCut, [](auto& c) { c.kill = true; }},
      {PreArmCheck::kFlightOver, [](auto& c) { c.phase = FlightPhase::kOff; }},
      {PreArmCheck::kPose, [](auto& c) { c.pose_known = false; }},
      {PreArmCheck::kPose, [](auto& c) { c.pose_age_s = 0.06; }},
      {PreArmCheck::kPad, [](auto& c) { c.place.x() = 0.51; }},
      {PreArmCheck::kPad, [](auto& c) { c.standing_error = -0.07; }},
      {PreArmCheck::kPad, [](auto& c) { c.standing_error = 0.07; }},
      {PreArmCheck::kUpright, [](auto& c) { c.tilt = 0.21; }},
      {PreArmCheck::kStill, [](auto& c) { c.drift = 0.051; }},
      {PreArmCheck::kFence, [](auto& c) { c.place.z() = 2.1; }},
      {PreArmCheck::kCameras, [](auto& c) { c.health.live_cameras = 1; }},
      {PreArmCheck::kFrameRate, [](auto& c) { c.health.frame_share = 0.94; }},
      {PreArmCheck::kResidual, [](auto& c) { c.health.residual_ratio = 3.1; }},
      {PreArmCheck::kResidual, [](auto& c) { c.health.cameras_disagree = true; }},
      {PreArmCheck::kCovariance, [](auto& c) { c.health.position_sigma = 0.051; }},
      {PreArmCheck::kCovariance, [](auto& c) { c.health.rotation_sigma = 0.27; }},
      {PreArmCheck::kYaw, [](auto& c) { c.health.yaw_ambiguous = true; }},
      {PreArmCheck::kTransmitter, [](auto& c) { c.health.transmitter_ready = false; }},
      {PreArmCheck::kTransmitter, [](auto& c) { c.health.transmitter_fault = true; }},
      {PreArmCheck::kChannels, [](auto& c) { c.health.channels_calibrated = false; }},
      {PreArmCheck::kPilot, [](auto& c) { c.health.pilot_flies = true; }},
      {PreArmCheck::kSticks, [](auto& c) { c.sticks_idle = false; }},
      {PreArmCheck::kRecord, [](auto& c) { c.health.record_failed = true; }},
      {PreArmCheck::kRecord, [](auto& c) { c.health.record_stalled = true; }},
      {PreArmCheck::kDisk, [](auto& c) { c.health.disk_free_gb = 0.9; }},
      {PreArmCheck::kCpu, [](auto& c) { c.health.tick_share = 0.9; }},
      {PreArmCheck::kStill, [](auto& c) { c.drift = std::numeric_limits<double>::quiet_NaN(); }},
      {PreArmCheck::kFrameRate,
       [](auto& c) { c.health.frame_share = std::numeric_limits<double>::quiet_NaN(); }},
  };
  std::uint32_t tried = 0;
  for (const auto& test : cases) {
    SupervisorConditions c = good();
    test.spoil(c);
    const SupervisorMemory memory = supervise(options, {}, c);
    EXPECT_FALSE(memory.armed) << toString(test.check);
    EXPECT_NE(memory.refused & bitOf(test.check), 0u) << toString(test.check);
    tried |= bitOf(test.check);
  }
  EXPECT_EQ(tried, (1u << kPreArmCheckCount) - 1) << "a check is not tested";
}

TEST(SupervisorProperties, WhatWasArmedIsDisarmedByOrderByTimeAndWhenItIsUnfitForLong) {
  const auto armed = [] {
    test::SupervisedFlight flight(FlightPhase::kIdle);
    flight.conditions.arm = true;
    flight.tick();
    flight.conditions.arm = false;
    EXPECT_TRUE(flight.memory.armed);
    return flight;
  };
  test::SupervisedFlight flight = armed();
  flight.conditions.disarm = true;
  EXPECT_FALSE(flight.tick().armed);

  flight = armed();
  for (int i = 0; i < 60 * 60 - 2; ++i) EXPECT_TRUE(flight.tick().armed);
  for (int i = 0; i < 4; ++i) flight.tick();
  EXPECT_FALSE(flight.memory.armed);

  flight = armed();
  flight.conditions.tilt = 1.0;
  for (int i = 0; i < 29; ++i) EXPECT_TRUE(flight.tick().armed);
  for (int i = 0; i < 4; ++i) flight.tick();
  EXPECT_FALSE(flight.memory.armed);
  flight.conditions.tilt = 0.0;
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(flight.tick().armed) << "never by itself";

  flight = armed();
  flight.conditions.phase = FlightPhase::kFlying;
  flight.conditions.disarm = true;
  EXPECT_TRUE(flight.tick().armed) << "not in the air: there is land, and there is STOP";
  flight.conditions.phase = FlightPhase::kOff;
  EXPECT_FALSE(flight.tick().armed) << "after a landing";
}

/// The same conditions and memory give the same answer: what a session logged can be asked again.
TEST(SupervisorProperties, IsAPureFunction) {
  const SupervisorOptions options;
  Random random(2);
  SupervisorMemory memory;
  for (int i = 0; i < 2000; ++i) {
    const SupervisorConditions c = randomConditions(random, fromSeconds(i * kTick));
    const SupervisorMemory once = supervise(options, memory, c), twice = supervise(options, memory, c);
    EXPECT_EQ(once.state, twice.state);
    EXPECT_EQ(once.armed, twice.armed);
    EXPECT_EQ(once.failsafes, twice.failsafes);
    EXPECT_EQ(once.alarms, twice.alarms);
    EXPECT_EQ(once.broken_since, twice.broken_since);
    EXPECT_EQ(once.descending_since, twice.descending_since);
    EXPECT_EQ(once.descent_s, twice.descent_s);
    memory = once;
  }
}

}  // namespace
}  // namespace helical
