#include "engine/transmitter/output_guard.h"

#include <gtest/gtest.h>

#include <limits>

#include "engine/base/error.h"
#include "engine/base/random.h"

namespace helical {
namespace {

constexpr StickDemand kFlying{0.5, 0.55, 0.2, -0.3};
constexpr TimeNs kMs = kNanosecondsPerMillisecond;

TEST(OutputGuard, IsLockedUntilAFreshDemandHasTheRotorsAtRest) {
  OutputGuard guard({});
  EXPECT_EQ(guard.step(kFlying, 1000 * kMs, 1001 * kMs), StickDemand{});
  EXPECT_EQ(guard.step({}, 1000 * kMs, 1200 * kMs), StickDemand{});
  EXPECT_TRUE(guard.locked()) << "that demand is old";
  EXPECT_EQ(guard.step({}, 1300 * kMs, 1301 * kMs), StickDemand{});
  EXPECT_FALSE(guard.locked());
  EXPECT_EQ(guard.step(kFlying, 1302 * kMs, 1303 * kMs), kFlying);
}

TEST(OutputGuard, GoesNeutralThenRampsDownThenLocks) {
  OutputGuardOptions options;
  options.hold_s = 0.2;
  options.ramp_per_s = 1.0;
  OutputGuard guard(options, false);
  EXPECT_EQ(guard.step(kFlying, 0, 100 * kMs), kFlying);
  EXPECT_EQ(guard.step(kFlying, 0, 101 * kMs), (StickDemand{0.5, 0.55, 0.0, 0.0}));
  EXPECT_EQ(guard.step(kFlying, 0, 299 * kMs), (StickDemand{0.5, 0.55, 0.0, 0.0}));
  EXPECT_NEAR(guard.step(kFlying, 0, 800 * kMs).upper_rotor, 0.25, 1e-9);
  EXPECT_EQ(guard.step(kFlying, 0, 1301 * kMs), StickDemand{});
  EXPECT_TRUE(guard.locked());
  EXPECT_EQ(guard.step(kFlying, 1302 * kMs, 1302 * kMs), StickDemand{}) << "it does not start by itself";
}

TEST(OutputGuard, TakesUpAgainAfterAShortSilence) {
  OutputGuard guard({}, false);
  guard.step(kFlying, 0, 1 * kMs);
  guard.step(kFlying, 0, 300 * kMs);
  EXPECT_EQ(guard.step(kFlying, 301 * kMs, 302 * kMs), kFlying);
}

/// Whatever comes when: nothing old is flown, and what was locked spins up only after a rest.
TEST(OutputGuard, PropertiesUnderRandomDemands) {
  Random random(3);
  const OutputGuardOptions options;
  for (int sequence = 0; sequence < 200; ++sequence) {
    OutputGuard guard(options);
    TimeNs now = 0, made = 0;
    StickDemand newest;
    bool rested = false;  // seen fresh, since it was last locked
    for (int i = 0; i < 500; ++i) {
      now += fromSeconds(random.uniform(0.001, random.uniform() < 0.02 ? 3.0 : 0.02));
      if (random.uniform() < 0.7) {
        made = now - fromSeconds(random.uniform(0.0, 0.01));
        newest = random.uniform() < 0.1 ? StickDemand{} : kFlying;
      }
      const bool fresh = toSeconds(now - made) <= options.silent_s;
      const bool was_locked = guard.locked();
      const StickDemand output = guard.step(newest, made, now);
      if (was_locked) {
        ASSERT_EQ(output, StickDemand{});
      }
      if (was_locked && !guard.locked()) rested = fresh && newest == StickDemand{};
      if (output.upper_rotor > 0.0) {
        ASSERT_TRUE(rested);
      }
      if (!fresh) {
        ASSERT_EQ(output.roll, 0.0);
        ASSERT_EQ(output.pitch, 0.0);
        ASSERT_LE(output.upper_rotor, kFlying.upper_rotor);
      }
      if (guard.locked()) rested = false;
    }
  }
}

TEST(OutputGuard, WhatIsNoNumberIsNotFlown) {
  OutputGuard guard({}, false);
  guard.step(kFlying, 0, 1 * kMs);
  StickDemand wrong = kFlying;
  wrong.pitch = std::numeric_limits<double>::quiet_NaN();
  for (int ms = 10; ms < 5000; ms += 10) {
    const StickDemand output = guard.step(wrong, ms * kMs, ms * kMs);
    ASSERT_EQ(output.pitch, 0.0);
    ASSERT_EQ(output.roll, 0.0);
    ASSERT_LE(output.upper_rotor, kFlying.upper_rotor);
  }
  EXPECT_TRUE(guard.locked()) << "ramped down as if nothing had come";
  wrong = {0.0, std::numeric_limits<double>::infinity(), 0.0, 0.0};
  EXPECT_EQ(guard.step(wrong, 5000 * kMs, 5000 * kMs), StickDemand{});
  EXPECT_TRUE(guard.locked());
}

TEST(OutputGuard, ValidatesItsOptions) {
  EXPECT_NO_THROW(validate(OutputGuardOptions{}));
  for (double OutputGuardOptions::*key :
       {&OutputGuardOptions::silent_s, &OutputGuardOptions::hold_s, &OutputGuardOptions::ramp_per_s}) {
    OutputGuardOptions options;
    options.*key = 0.0;
    EXPECT_THROW(validate(options), Error);
  }
}

}  // namespace
}  // namespace helical
