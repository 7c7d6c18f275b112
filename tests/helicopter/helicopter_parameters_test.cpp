#include "engine/helicopter/helicopter_parameters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"

namespace helical {
namespace {

TEST(HelicopterParameters, AtHoverThrustCarriesTheWeightAndTorquesCancel) {
  for (const HelicopterParameters& p : {HelicopterParameters::xrb(), HelicopterParameters::coax()}) {
    const double upper = p.hoverSpeedUpper(), lower = p.hoverSpeedLower();
    EXPECT_NEAR(p.upper.thrust_coefficient * upper * upper + p.lower.thrust_coefficient * lower * lower,
                p.mass * kGravity, 1e-12);
    EXPECT_NEAR(p.upper.drag_coefficient * upper * upper, p.lower.drag_coefficient * lower * lower, 1e-12);
    EXPECT_NEAR(p.upper.motor_gain * p.hoverStickUpper() + p.upper.motor_offset, upper, 1e-9);
    EXPECT_NEAR(p.lower.motor_gain * p.hoverStickLower() + p.lower.motor_offset, lower, 1e-9);
    EXPECT_GT(p.hoverStickUpper(), 0.3);
    EXPECT_LT(p.hoverStickLower(), 0.8);
  }
}

void expectWithin(double value, double nominal, double fraction) {
  EXPECT_LE(std::abs(value - nominal), fraction * std::abs(nominal) * (1.0 + 1e-12));
}

TEST(HelicopterParameters, VariedOnesStayWithinTheirFractionAndCanHover) {
  const HelicopterParameters nominal = HelicopterParameters::xrb();
  constexpr double kFraction = 0.3;
  double lightest = 1.0, heaviest = 0.0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    Random random(seed);
    const HelicopterParameters p = varied(nominal, kFraction, random);
    expectWithin(p.mass, nominal.mass, kFraction);
    expectWithin(p.inertia_z, nominal.inertia_z, kFraction);
    expectWithin(p.upper.thrust_coefficient, nominal.upper.thrust_coefficient, kFraction);
    expectWithin(p.lower.phase_offset, nominal.lower.phase_offset, kFraction);
    expectWithin(p.lower.motor_time, nominal.lower.motor_time, kFraction);
    expectWithin(p.bar_time, nominal.bar_time, kFraction);
    EXPECT_LE(std::abs(p.swash_plate_offset_roll), 0.3 * kFraction);
    EXPECT_LE(std::abs(p.swash_plate_offset_pitch), 0.3 * kFraction);
    EXPECT_LE(std::hypot(p.thrust_offset_x, p.thrust_offset_y), 0.01 * kFraction * std::sqrt(2.0));
    EXPECT_EQ(p.standing_height, nominal.standing_height);
    for (const double stick : {p.hoverStickUpper(), p.hoverStickLower()}) {
      EXPECT_GT(stick, 0.3);
      EXPECT_LT(stick, 0.8);
    }
    lightest = std::min(lightest, p.mass);
    heaviest = std::max(heaviest, p.mass);
  }
  EXPECT_LT(lightest, nominal.mass * 0.75);
  EXPECT_GT(heaviest, nominal.mass * 1.25);
}

TEST(HelicopterParameters, VariedOnesRepeatForASeed) {
  Random a(9), b(9), c(10);
  const HelicopterParameters nominal = HelicopterParameters::xrb();
  const HelicopterParameters first = varied(nominal, 0.2, a);
  EXPECT_EQ(first.mass, varied(nominal, 0.2, b).mass);
  EXPECT_NE(first.mass, varied(nominal, 0.2, c).mass);
  EXPECT_EQ(varied(nominal, 0.0, a).mass, nominal.mass);
}

TEST(HelicopterParameters, AHelicopterThatCanNeverHoverIsRefused) {
  HelicopterParameters heavy = HelicopterParameters::xrb();
  heavy.mass = 5.0;
  Random random(1);
  EXPECT_THROW(varied(heavy, 0.1, random), Error);
}

}  // namespace
}  // namespace helical
