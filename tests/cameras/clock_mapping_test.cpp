#include "engine/cameras/clock_mapping.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/base/random.h"

namespace helical {
namespace {

constexpr TimeNs kMs = kNanosecondsPerMillisecond;

/// A camera's clock beside ours.
struct Camera {
  TimeNs offset;
  double drift;
  TimeNs device(TimeNs host) const { return host + offset + static_cast<TimeNs>(drift * static_cast<double>(host)); }
};

TimeNs worstError(const ClockMapping& mapping, const Camera& camera, TimeNs from, TimeNs to) {
  TimeNs worst = 0;
  for (TimeNs host = from; host <= to; host += 50 * kMs)
    worst = std::max(worst, std::abs(mapping.host(camera.device(host)) - host));
  return worst;
}

class ClockMappingOf : public testing::TestWithParam<double> {};

TEST_P(ClockMappingOf, ReadClocksIsRightToATenthOfAMillisecond) {
  const Camera camera{static_cast<TimeNs>(GetParam() * 1e9), std::copysign(50e-6, GetParam())};
  ClockMapping mapping;
  Random random(3);
  for (int i = 0; i < 10; ++i) {
    const TimeNs host = 5'000 * kMs + i * 1000 * kMs;
    const double off = 1e5 * random.normal();  // a tenth of a millisecond
    mapping.add({camera.device(host), host + static_cast<TimeNs>(off), 100'000});
  }
  EXPECT_LT(worstError(mapping, camera, 13'000 * kMs, 16'000 * kMs), 200'000);
  // ours passes less per nanosecond of a clock that is fast
  EXPECT_NEAR(mapping.drift(), -camera.drift, 40e-6);
  EXPECT_LT(mapping.sigma(), 1e-4);
}

TEST_P(ClockMappingOf, ArrivalsAloneIsRightToAMillisecondWithinTenSeconds) {
  const Camera camera{static_cast<TimeNs>(GetParam() * 1e9), std::copysign(50e-6, GetParam())};
  ClockMapping mapping;
  Random random(4);
  constexpr TimeNs kDelay = 8 * kMs;
  for (int i = 0; i < 600; ++i) {
    const TimeNs exposure = 2'000 * kMs + i * 16'666'667LL;
    // most are late by a little, some by a lot, none early
    const double late = 0.1e6 * random.uniform() + (random.uniform() < 0.2 ? 8e6 * random.uniform() : 0.0);
    mapping.addArrival(camera.device(exposure), exposure + kDelay + static_cast<TimeNs>(late), kDelay);
  }
  EXPECT_LT(worstError(mapping, camera, 11'000 * kMs, 13'000 * kMs), 1 * kMs);
}

INSTANTIATE_TEST_SUITE_P(Offsets, ClockMappingOf, testing::Values(-0.02, 0.02, 12.0));

TEST(ClockMapping, OneSampleGivesTheOffsetAndNoDrift) {
  ClockMapping mapping;
  EXPECT_FALSE(mapping.known());
  mapping.add({1000 * kMs, 7000 * kMs, 100'000});
  EXPECT_TRUE(mapping.known());
  EXPECT_EQ(mapping.host(1100 * kMs), 7100 * kMs);
  EXPECT_EQ(mapping.drift(), 0.0);
}

TEST(ClockMapping, TwoNoisySamplesCloseTogetherMakeNoWildDrift) {
  ClockMapping mapping;
  mapping.add({0, 5000 * kMs, 100'000});
  mapping.add({100 * kMs, 5100 * kMs + 200'000, 100'000});  // 2000 millionths, were it true
  EXPECT_LT(std::abs(mapping.drift()), 100e-6);
}

TEST(ClockMapping, ReadingsThatTookLongCountLittle) {
  const Camera camera{3 * kMs, 0.0};
  ClockMapping mapping;
  for (int i = 0; i < 10; ++i) {
    const TimeNs host = i * 1000 * kMs;
    const bool slow = i % 3 == 2;
    mapping.add({camera.device(host), host + (slow ? 20 * kMs : 0), slow ? 20 * kMs : 50'000});
  }
  EXPECT_LT(worstError(mapping, camera, 8'000 * kMs, 10'000 * kMs), 50'000);
}

TEST(ClockMapping, ForgetsACameraThatRestarted) {
  ClockMapping mapping;
  mapping.add({500'000 * kMs, 600'000 * kMs, 100'000});
  mapping.reset();
  EXPECT_FALSE(mapping.known());
  mapping.add({1 * kMs, 700'000 * kMs, 100'000});
  EXPECT_EQ(mapping.host(2 * kMs), 700'001 * kMs);
}

}  // namespace
}  // namespace helical
