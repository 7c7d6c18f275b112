#include "engine/calibration/vector_math.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/base/random.h"
#include "engine/calibration/normal_deviates.h"

namespace helical {
namespace {

TEST(VectorMath, ExponentialIsExactToSixDigitsAndVanishesFarOut) {
  Random random(2);
  for (int i = 0; i < 100000; ++i) {
    const auto x = static_cast<float>(-std::pow(random.uniform(), 3.0) * 86.9);
    EXPECT_NEAR(static_cast<double>(expOfNegative(x)) / std::exp(static_cast<double>(x)), 1.0, 3e-7) << x;
  }
  EXPECT_EQ(expOfNegative(0.0F), 1.0F);
  EXPECT_EQ(expOfNegative(-88.0F), 0.0F);
  EXPECT_EQ(expOfNegative(-std::numeric_limits<float>::infinity()), 0.0F);
}

TEST(VectorMath, LogarithmIsExactToSixDigits) {
  Random random(3);
  for (int i = 0; i < 100000; ++i) {
    const auto x = static_cast<float>(std::pow(10.0, random.uniform(-37.0, 37.0)));
    const double exact = std::log(static_cast<double>(x));
    EXPECT_NEAR(static_cast<double>(logOfPositive(x)), exact, 1e-7 + 2e-7 * std::abs(exact)) << x;
    const auto near_one = static_cast<float>(random.uniform(0.5, 2.0));
    EXPECT_NEAR(static_cast<double>(logOfPositive(near_one)), std::log(static_cast<double>(near_one)), 1e-7);
  }
  EXPECT_EQ(logOfPositive(1.0F), 0.0F);
}

TEST(VectorMath, CosineAndSineOfEveryQuarterTurn) {
  Random random(4);
  for (int i = 0; i < 100000; ++i) {
    const auto bits = static_cast<std::uint32_t>(random.bits() >> 32);
    const double angle = 2.0 * 3.14159265358979323846 * (static_cast<double>(bits) * 0x1.0p-32);
    const CosineSine turn = cosineSineOfTurn(bits);
    EXPECT_NEAR(static_cast<double>(turn.cosine), std::cos(angle), 2e-7) << bits;
    EXPECT_NEAR(static_cast<double>(turn.sine), std::sin(angle), 2e-7) << bits;
  }
}

TEST(NormalDeviates, HaveTheMomentsAndTailsOfANormalDistribution) {
  NormalDeviates deviates(1);
  std::vector<float> x(1'000'000);
  deviates.fill(x);
  std::array<double, 5> moment{};
  int beyond_three = 0;
  double neighbours = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (int k = 1; k <= 4; ++k) moment[static_cast<std::size_t>(k)] += std::pow(x[i], k) / 1e6;
    if (std::abs(x[i]) > 3.0F) ++beyond_three;
    if (i >= kLanes) neighbours += static_cast<double>(x[i] * x[i - kLanes]) / 1e6;
  }
  EXPECT_NEAR(moment[1], 0.0, 0.004);
  EXPECT_NEAR(moment[2], 1.0, 0.006);
  EXPECT_NEAR(moment[3], 0.0, 0.02);
  EXPECT_NEAR(moment[4], 3.0, 0.05);
  EXPECT_NEAR(beyond_three, 2700, 250);
  EXPECT_NEAR(neighbours, 0.0, 0.004);
}

/// Another machine, compiler or width of vectors draws the same.
TEST(NormalDeviates, AreTheSameBitsEverywhere) {
  NormalDeviates deviates(7);
  std::vector<float> x(100);
  deviates.fill(x);
  std::uint32_t hash = 0;
  for (const float each : x) hash = (hash * 16777619U) ^ std::bit_cast<std::uint32_t>(each);
  EXPECT_EQ(hash, 2555514372U);
}

}  // namespace
}  // namespace helical
