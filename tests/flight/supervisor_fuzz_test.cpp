// Conditions that are no numbers, or absurd ones, in any order: nothing arms on them, nothing flies on them, kill and cut
// hold. Deterministic: the same sequence on every run.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/flight/pre_arm.h"
#include "tests/flight/supervised_flight.h"

namespace helical {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Each field of its own, so that a mutation can be told from what it was before.
double* fieldOf(SupervisorConditions& c, int field) {
  double* const fields[] = {&c.pose_age_s,  &c.tilt, &c.speed, &c.drift, &c.place.x(), &c.place.y(), &c.place.z(),
                            &c.standing_error, &c.flight_time_s, &c.health.frame_share, &c.health.tick_share,
                            &c.health.overrun_s, &c.health.position_sigma, &c.health.rotation_sigma,
                            &c.health.residual_ratio, &c.health.disk_free_gb};
  return fields[static_cast<std::size_t>(field) % std::size(fields)];
}
constexpr int kFields = 16;

/// The flight's time and a late tick have nothing to do with arming.
bool isHarmless(int field) {
  return field == 8 || field == 11;
}

void mutate(Random& random, SupervisorConditions& c) {
  constexpr double kWild[] = {kNaN, kInfinity, -kInfinity, 1e308, -1e308, 5e-324, -0.0};
  const int count = static_cast<int>(random.uniform(0.0, 3.0));
  for (int i = 0; i < count; ++i)
    *fieldOf(c, static_cast<int>(random.uniform() * kFields)) = kWild[static_cast<std::size_t>(random.uniform() * std::size(kWild))];
  if (random.uniform() < 0.01) c.phase = static_cast<FlightPhase>(random.bits() % 7);
  if (random.uniform() < 0.01) c.health.live_cameras = static_cast<int>(random.bits());
}

TEST(SupervisorFuzz, NothingArmsOrFliesOnWhatIsNoNumber) {
  const SupervisorOptions options;
  Random random(77);
  int armings = 0, blind = 0;
  for (int sequence = 0; sequence < 3000; ++sequence) {
    SupervisorMemory memory;
    TimeNs now = 0;
    for (int i = 0; i < 100; ++i) {
      now += fromSeconds(test::kTick);
      SupervisorConditions c = test::randomConditions(random, now);
      mutate(random, c);
      const SupervisorMemory before = memory;
      memory = supervise(options, before, c);
      if (c.kill || before.state == SafetyState::kCut) {
        ASSERT_EQ(memory.state, SafetyState::kCut);
      }
      if (memory.armed && !before.armed) {
        ++armings;
        ASSERT_TRUE(c.arm);
        ASSERT_FALSE(c.kill);
        for (int field = 0; field < kFields; ++field) ASSERT_FALSE(!isHarmless(field) && std::isnan(*fieldOf(c, field))) << field;
      }
      const bool sound = c.place.allFinite() && std::isfinite(c.tilt) && std::isfinite(c.speed) && !std::isnan(c.pose_age_s);
      if (rotorsTurn(c.phase) && !sound) {
        ++blind;
        ASSERT_GE(memory.state, SafetyState::kDescending);
      }
    }
  }
  EXPECT_GT(armings, 20);
  EXPECT_GT(blind, 1000);
}

TEST(SupervisorFuzz, EachFieldThatIsNoNumberKeepsItFromArming) {
  const SupervisorOptions options;
  for (int field = -1; field < kFields; ++field) {
    SupervisorConditions c;
    c.now = kNanosecondsPerSecond;
    c.arm = true;
    if (field >= 0) *fieldOf(c, field) = kNaN;
    const bool armed = supervise(options, {}, c).armed;
    EXPECT_EQ(armed, field < 0 || isHarmless(field)) << field;
  }
}

}  // namespace
}  // namespace helical
