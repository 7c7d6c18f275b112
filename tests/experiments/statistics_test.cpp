#include "engine/experiments/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/base/random.h"

namespace helical {
namespace {

TEST(Quantile, InterpolatesBetweenNeighbours) {
  EXPECT_EQ(quantile({3.0, 1.0, 2.0}, 0.5), 2.0);
  EXPECT_DOUBLE_EQ(quantile({1.0, 2.0, 3.0, 4.0}, 0.5), 2.5);
  EXPECT_EQ(quantile({5.0}, 0.9), 5.0);
  EXPECT_EQ(quantile({1.0, 2.0}, 1.0), 2.0);
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
}

TEST(Quantile, ValuesThatAreNotFiniteAreTheLargest) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(quantile({std::nan(""), 1.0, 2.0}, 0.5), 2.0);
  EXPECT_EQ(quantile({infinity, std::nan(""), 2.0}, 0.75), infinity);
}

TEST(QuantileInterval, HoldsTheTrueMedianNineteenTimesOutOfTwenty) {
  Random random(11);
  constexpr int kTrials = 2000;
  int holds = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> values;
    for (int i = 0; i < 40; ++i) values.push_back(random.normal());
    const Interval interval = quantileInterval(values, 0.5);
    EXPECT_LE(interval.low, interval.value);
    EXPECT_GE(interval.high, interval.value);
    holds += interval.low <= 0.0 && interval.high >= 0.0;
  }
  EXPECT_GT(holds, 0.93 * kTrials);
  EXPECT_LT(holds, 0.99 * kTrials);
}

TEST(QuantileInterval, SaysSoWhenItReachesWhatNeverHappened) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(quantileInterval({1.0, 2.0, 3.0, infinity}, 0.9).high, infinity);
}

TEST(Proportion, HasWilsonsInterval) {
  // Newcombe (1998), table I: 81 of 263.
  const Proportion share = proportion(81, 263);
  EXPECT_NEAR(share.value, 0.308, 5e-4);
  EXPECT_NEAR(share.low, 0.2553, 5e-5);
  EXPECT_NEAR(share.high, 0.3662, 5e-5);
}

TEST(Proportion, StaysWithinZeroAndOne) {
  const Proportion none = proportion(0, 20), all = proportion(20, 20);
  EXPECT_EQ(none.low, 0.0);
  EXPECT_NEAR(none.high, 0.1611, 5e-5);
  EXPECT_NEAR(all.low, 1.0 - none.high, 1e-12);
  EXPECT_EQ(all.high, 1.0);
}

}  // namespace
}  // namespace helical
