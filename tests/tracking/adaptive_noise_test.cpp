#include "engine/tracking/adaptive_noise.h"

#include <gtest/gtest.h>

namespace helical {
namespace {

using Eigen::Vector3d;

const MotionNoise kNominal{0.2, 0.3, 2.0, 3.0};
const Vector3d kVariance(0.04, 0.04, 0.04), kSpinVariance(0.25, 0.25, 0.25);

/// Corrections of so many standard deviations, velocity and spin.
void learn(AdaptiveNoise& noise, double velocity, double spin, int times, bool airborne = true) {
  for (int i = 0; i < times; ++i)
    noise.learn(velocity * kVariance.cwiseSqrt(), kVariance, spin * kSpinVariance.cwiseSqrt(), kSpinVariance,
                airborne);
}

TEST(AdaptiveNoise, StaysWhereItIsWhileTheCorrectionsAreAsExpected) {
  AdaptiveNoise noise(kNominal);
  learn(noise, 1.0, 1.0, 10000);
  EXPECT_NEAR(noise.noise().lateral, kNominal.lateral, 1e-9);
  EXPECT_NEAR(noise.noise().vertical, kNominal.vertical, 1e-9);
  EXPECT_NEAR(noise.noise().tilt, kNominal.tilt, 1e-9);
  EXPECT_NEAR(noise.noise().yaw, kNominal.yaw, 1e-9);
}

TEST(AdaptiveNoise, RisesWithSurprisesAndFallsInTheCalm) {
  AdaptiveNoise noise(kNominal);
  learn(noise, 2.0, 1.0, 20);
  EXPECT_GT(noise.noise().lateral, 1.5 * kNominal.lateral);
  EXPECT_GT(noise.noise().vertical, 1.5 * kNominal.vertical);
  EXPECT_NEAR(noise.noise().tilt, kNominal.tilt, 1e-9) << "every group by itself";
  learn(noise, 0.2, 0.2, 200);
  EXPECT_LT(noise.noise().lateral, kNominal.lateral);
  EXPECT_LT(noise.noise().tilt, kNominal.tilt);
}

TEST(AdaptiveNoise, EveryGroupListensToItsOwnAxes) {
  AdaptiveNoise noise(kNominal);
  for (int i = 0; i < 50; ++i) noise.learn({0.2, 0.2, 0.9}, kVariance, {0.5, 0.5, 1.5}, kSpinVariance, true);
  EXPECT_NEAR(noise.noise().lateral, kNominal.lateral, 1e-9);
  EXPECT_GT(noise.noise().vertical, 2.0 * kNominal.vertical);
  EXPECT_NEAR(noise.noise().tilt, kNominal.tilt, 1e-9);
  EXPECT_GT(noise.noise().yaw, 2.0 * kNominal.yaw);
}

TEST(AdaptiveNoise, IsBounded) {
  AdaptiveNoise noise(kNominal);
  learn(noise, 1000.0, 1000.0, 10000);
  EXPECT_GT(noise.noise().lateral, 5.0 * kNominal.lateral);
  EXPECT_LT(noise.noise().lateral, 20.0 * kNominal.lateral);
  EXPECT_LT(noise.noise().yaw, 20.0 * kNominal.yaw);
  learn(noise, 0.0, 0.0, 100000);
  EXPECT_GT(noise.noise().lateral, 0.05 * kNominal.lateral);
  EXPECT_LT(noise.noise().lateral, 0.5 * kNominal.lateral);
}

TEST(AdaptiveNoise, OneSurpriseAloneMovesLittle) {
  AdaptiveNoise noise(kNominal);
  learn(noise, 1e6, 1e6, 1);
  EXPECT_LT(noise.noise().lateral, 1.5 * kNominal.lateral);
}

TEST(AdaptiveNoise, OnTheGroundItIsNeverBelowNominal) {
  AdaptiveNoise noise(kNominal);
  learn(noise, 0.0, 0.0, 1000, true);
  ASSERT_LT(noise.noise().vertical, kNominal.vertical);
  learn(noise, 0.0, 0.0, 1, false);
  EXPECT_GE(noise.noise().lateral, kNominal.lateral);
  EXPECT_GE(noise.noise().vertical, kNominal.vertical);
  EXPECT_GE(noise.noise().tilt, kNominal.tilt);
  EXPECT_GE(noise.noise().yaw, kNominal.yaw);
}

TEST(AdaptiveNoise, WithoutExpectationNothingIsASurprise) {
  AdaptiveNoise noise(kNominal);
  for (int i = 0; i < 100; ++i)
    noise.learn(Vector3d::Ones(), Vector3d::Zero(), Vector3d::Ones(), Vector3d::Zero(), true);
  EXPECT_NEAR(noise.noise().lateral, kNominal.lateral, 1e-9);
}

TEST(AdaptiveNoise, ResetIsNominal) {
  AdaptiveNoise noise(kNominal);
  learn(noise, 5.0, 5.0, 100);
  noise.reset();
  EXPECT_EQ(noise.noise().lateral, kNominal.lateral);
  EXPECT_EQ(noise.noise().yaw, kNominal.yaw);
  learn(noise, 1.0, 1.0, 1);
  EXPECT_NEAR(noise.noise().lateral, kNominal.lateral, 1e-9);
}

}  // namespace
}  // namespace helical
