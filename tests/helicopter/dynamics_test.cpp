#include "engine/helicopter/dynamics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/random.h"
#include "engine/geometry/rotation.h"

namespace helical {
namespace {

constexpr double kStep = 1e-3;

void fly(Dynamics& dynamics, const StickDemand& demand, double seconds, const Gust& gust = {}) {
  for (int i = 0; i < static_cast<int>(std::lround(seconds / kStep)); ++i) dynamics.step(demand, gust, kStep);
}

StickDemand hover(const HelicopterParameters& p) {
  return {p.hoverStickUpper(), p.hoverStickLower(), 0.0, 0.0};
}

double heightOf(const Dynamics& dynamics) {
  return dynamics.state().world_from_body.translation.z();
}

/// The helicopter without ground effect, which would push it up, and the sticks that keep its height.
HelicopterParameters withoutGroundEffect() {
  HelicopterParameters p = HelicopterParameters::xrb();
  p.ground_effect = 0.0;
  return p;
}

/// Takes it off the ground by full throttle for a moment and back to the hover sticks until its climb has
/// died down.
Dynamics airborne(const HelicopterParameters& p) {
  Dynamics dynamics(p);
  dynamics.placeOnGround(0, 0, 0);
  StickDemand climb = hover(p);
  climb.upper_rotor *= 1.1;
  climb.lower_rotor *= 1.1;
  fly(dynamics, climb, 2.5);
  fly(dynamics, hover(p), 0.5);
  return dynamics;
}

TEST(Dynamics, RestsOnItsSkidsWithRotorsOff) {
  Dynamics dynamics(HelicopterParameters::xrb());
  dynamics.placeOnGround(0.3, -0.2, 0.7);
  fly(dynamics, {}, 3.0);
  const HelicopterState state = dynamics.state();
  EXPECT_TRUE(dynamics.onGround());
  EXPECT_NEAR(state.world_from_body.translation.x(), 0.3, 1e-4);
  EXPECT_NEAR(state.world_from_body.translation.y(), -0.2, 1e-4);
  EXPECT_NEAR(state.world_from_body.translation.z(), dynamics.parameters().standing_height, 0.003);
  EXPECT_NEAR(yawOf(state.world_from_body.rotation), 0.7, 1e-4);
  EXPECT_NEAR(tiltOf(state.world_from_body.rotation), 0.0, 1e-3);
  EXPECT_LT(state.velocity_in_world.norm(), 1e-4);
  EXPECT_LT(dynamics.hardestTouch(), 0.05);
}

TEST(Dynamics, FallsFreelyWithoutThrust) {
  HelicopterParameters p = withoutGroundEffect();
  p.drag_area_x = p.drag_area_y = p.drag_area_z = p.lateral_damping = p.vertical_damping = 0.0;
  // Motors that stop at once: what is left is gravity alone.
  p.upper.motor_time = p.lower.motor_time = 0.01;
  Dynamics dynamics = airborne(p);
  fly(dynamics, {}, 0.2);
  ASSERT_FALSE(dynamics.onGround());
  const double before = dynamics.state().velocity_in_world.z();
  const double height = heightOf(dynamics);
  fly(dynamics, {}, 0.1);
  ASSERT_FALSE(dynamics.onGround());
  EXPECT_NEAR(dynamics.state().velocity_in_world.z() - before, -kGravity * 0.1, 1e-5);
  EXPECT_NEAR(heightOf(dynamics) - height, before * 0.1 - 0.5 * kGravity * 0.01, 1e-5);
}

TEST(Dynamics, FallingGivesUpNoMoreEnergyThanGravityPutsIn) {
  Dynamics dynamics = airborne(withoutGroundEffect());
  const double mass = dynamics.parameters().mass;
  const auto energy = [&] {
    return mass * (kGravity * heightOf(dynamics) + 0.5 * dynamics.state().velocity_in_world.squaredNorm());
  };
  fly(dynamics, {}, 0.5);  // rotors run down
  double last = energy();
  for (int i = 0; i < 5000; ++i) {
    fly(dynamics, {}, kStep);
    if (dynamics.onGround()) break;
    EXPECT_LE(energy(), last + 5e-5) << "drag takes energy";
    last = energy();
  }
  fly(dynamics, {}, 3.0);
  EXPECT_TRUE(dynamics.onGround());
  EXPECT_GT(dynamics.hardestTouch(), 0.5);
  EXPECT_LT(dynamics.state().velocity_in_world.norm(), 1e-2) << "the skids' dampers bring it to rest";
}

TEST(Dynamics, KeepsItsHeightAtTheHoverSticks) {
  Dynamics dynamics = airborne(withoutGroundEffect());
  fly(dynamics, hover(dynamics.parameters()), 20.0);  // the climb dies down by vertical damping
  ASSERT_FALSE(dynamics.onGround());
  const double height = heightOf(dynamics);
  fly(dynamics, hover(dynamics.parameters()), 2.0);
  EXPECT_NEAR(heightOf(dynamics), height, 0.02);
  EXPECT_LT(std::abs(dynamics.state().velocity_in_world.z()), 0.02);
  EXPECT_NEAR(dynamics.upperRotorSpeed(), dynamics.parameters().hoverSpeedUpper(), 0.1);
  EXPECT_NEAR(dynamics.lowerRotorSpeed(), dynamics.parameters().hoverSpeedLower(), 0.1);
}

TEST(Dynamics, GroundEffectLiftsNearTheGround) {
  HelicopterParameters p = HelicopterParameters::xrb();
  Dynamics with(p), without(withoutGroundEffect());
  for (Dynamics* dynamics : {&with, &without}) {
    StickDemand demand = hover(p);
    demand.upper_rotor *= 1.01;
    demand.lower_rotor *= 1.01;
    fly(*dynamics, demand, 3.0);
  }
  EXPECT_GT(heightOf(with), heightOf(without) + 0.01);
}

/// The lower rotor's drag turns the body to positive yaw, the upper's to negative.
TEST(Dynamics, YawFollowsTheDifferenceOfTheRotors) {
  for (const double sign : {1.0, -1.0}) {
    Dynamics dynamics = airborne(withoutGroundEffect());
    const double spin = dynamics.state().angular_velocity_in_body.z();
    StickDemand demand = hover(dynamics.parameters());
    demand.lower_rotor += sign * 0.02;
    demand.upper_rotor -= sign * 0.02;
    fly(dynamics, demand, 0.5);
    EXPECT_GT(sign * (dynamics.state().angular_velocity_in_body.z() - spin), 0.05);
  }
}

/// Positive pitch tips the thrust to +x of the body, positive roll to -y.
TEST(Dynamics, TheSwashPlateTipsTheThrustAsTheSticksSay) {
  const auto flown = [](double roll, double pitch) {
    Dynamics dynamics = airborne(withoutGroundEffect());
    StickDemand demand = hover(dynamics.parameters());
    demand.roll = roll;
    demand.pitch = pitch;
    fly(dynamics, demand, 1.0);
    return dynamics.state().velocity_in_world;
  };
  const Eigen::Vector3d still = flown(0, 0);
  for (const double sign : {1.0, -1.0}) {
    const Eigen::Vector3d pitched = flown(0, sign * 0.3) - still, rolled = flown(sign * 0.3, 0) - still;
    EXPECT_GT(sign * pitched.x(), 0.05);
    EXPECT_GT(sign * pitched.x(), 2.0 * std::abs(pitched.y())) << pitched.transpose();
    EXPECT_LT(sign * rolled.y(), -0.05);
    EXPECT_LT(sign * rolled.y(), -2.0 * std::abs(rolled.x())) << rolled.transpose();
  }
}

TEST(Dynamics, WindCarriesItAlong) {
  Dynamics calm = airborne(withoutGroundEffect()), windy = calm;
  Gust gust;
  gust.wind_in_world = {0.0, 1.0, 0.0};
  fly(calm, hover(calm.parameters()), 1.0);
  fly(windy, hover(windy.parameters()), 1.0, gust);
  EXPECT_GT(windy.state().velocity_in_world.y(), calm.state().velocity_in_world.y() + 0.05);
}

TEST(Dynamics, KeepsUnitQuaternionsAndFiniteStatesUnderAnySticks) {
  Random random(4);
  for (int flight = 0; flight < 20; ++flight) {
    const HelicopterParameters p = varied(HelicopterParameters::xrb(), 0.3, random);
    Dynamics dynamics(p);
    for (int i = 0; i < 40; ++i) {
      const StickDemand demand{random.uniform(-0.5, 1.5), random.uniform(-0.5, 1.5),
                               random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0)};
      Gust gust;
      gust.wind_in_world = {random.normal(), random.normal(), random.normal()};
      fly(dynamics, demand, 0.05, gust);
      const HelicopterState state = dynamics.state();
      ASSERT_TRUE(state.world_from_body.translation.allFinite());
      ASSERT_TRUE(state.velocity_in_world.allFinite());
      ASSERT_TRUE(state.angular_velocity_in_body.allFinite());
      ASSERT_NEAR(state.world_from_body.rotation.norm(), 1.0, 1e-12);
      ASSERT_LE(dynamics.upperRotorSpeed(), p.maximum_rotor_speed);
      ASSERT_GE(dynamics.lowerRotorSpeed(), 0.0);
    }
  }
}

TEST(Dynamics, RepeatsBitForBit) {
  Dynamics a(HelicopterParameters::xrb()), b(HelicopterParameters::xrb());
  StickDemand demand = hover(a.parameters());
  demand.pitch = 0.1;
  demand.upper_rotor *= 1.1;
  fly(a, demand, 3.0);
  fly(b, demand, 3.0);
  EXPECT_EQ(a.state().world_from_body.translation, b.state().world_from_body.translation);
  EXPECT_EQ(a.state().world_from_body.rotation.coeffs(), b.state().world_from_body.rotation.coeffs());
}

TEST(Dynamics, HalvingTheStepChangesLittle) {
  Dynamics coarse = airborne(withoutGroundEffect()), fine = coarse;
  StickDemand demand = hover(coarse.parameters());
  demand.roll = 0.2;
  fly(coarse, demand, 2.0);
  for (int i = 0; i < 4000; ++i) fine.step(demand, {}, 0.5 * kStep);
  EXPECT_LT((coarse.state().world_from_body.translation - fine.state().world_from_body.translation).norm(),
            2e-3);
}

}  // namespace
}  // namespace helical
