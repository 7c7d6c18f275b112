#include "engine/simulator/world.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/geometry/rotation.h"

namespace helical {
namespace {

constexpr double kHop = 1.25;  ///< hover trims that lift it off

SimulationOptions seeded(std::uint64_t seed) {
  SimulationOptions options;
  options.seed = seed;
  return options;
}

StickDemand throttle(double trims) {
  const HelicopterParameters p = HelicopterParameters::xrb();
  return {trims * p.hoverStickUpper(), trims * p.hoverStickLower(), 0.0, 0.0};
}

HelicopterState after(World& world, double seconds) {
  world.advanceTo(fromSeconds(seconds));
  return world.at(fromSeconds(seconds))->state;
}

TEST(World, RepeatsForASeedWhateverTheSizeOfItsSteps) {
  SimulationOptions options = seeded(3);
  options.vary = 0.3;
  World a(options, HelicopterParameters::xrb()), b(options, HelicopterParameters::xrb());
  for (World* world : {&a, &b}) world->command(throttle(kHop), fromSeconds(0.5));
  for (int i = 1; i <= 600; ++i) a.advanceTo(i * 2 * kNanosecondsPerMillisecond);
  b.advanceTo(fromSeconds(1.2));
  const auto pose_a = a.at(fromSeconds(1.2))->state, pose_b = b.at(fromSeconds(1.2))->state;
  EXPECT_EQ(pose_a.world_from_body.translation, pose_b.world_from_body.translation);
  EXPECT_EQ(pose_a.world_from_body.rotation.coeffs(), pose_b.world_from_body.rotation.coeffs());
  EXPECT_EQ(pose_a.velocity_in_world, pose_b.velocity_in_world);
}

TEST(World, OtherSeedsAreOtherWorlds) {
  SimulationOptions options = seeded(3);
  options.vary = 0.3;
  World a(options, HelicopterParameters::xrb());
  options.seed = 4;
  World b(options, HelicopterParameters::xrb());
  EXPECT_NE(a.parameters().mass, b.parameters().mass);
  EXPECT_NE(after(a, 1.0).world_from_body.translation, after(b, 1.0).world_from_body.translation);
}

TEST(World, VariedParametersStayWithinTheirFraction) {
  const double nominal = HelicopterParameters::xrb().mass;
  double lightest = 1.0, heaviest = 0.0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SimulationOptions options = seeded(seed);
    EXPECT_EQ(World(options, HelicopterParameters::xrb()).parameters().mass, nominal);
    options.vary = 0.2;
    const double mass = World(options, HelicopterParameters::xrb()).parameters().mass / nominal;
    EXPECT_NEAR(mass, 1.0, 0.2);
    lightest = std::min(lightest, mass);
    heaviest = std::max(heaviest, mass);
  }
  EXPECT_LT(lightest, 0.9);
  EXPECT_GT(heaviest, 1.1);
}

TEST(World, FieldIsEmptyAtFirst) {
  SimulationOptions options;
  options.field_empty_s = 0.4;
  World world(options, HelicopterParameters::xrb());
  world.advanceTo(fromSeconds(0.6));
  EXPECT_FALSE(world.at(fromSeconds(0.38)).has_value());
  EXPECT_FALSE(world.at(fromSeconds(0.399)).has_value());
  EXPECT_TRUE(world.at(fromSeconds(0.4)).has_value());
  EXPECT_TRUE(world.at(fromSeconds(0.6)).has_value());
}

TEST(World, HelicopterIsPutOnThePad) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    World world(seeded(seed), HelicopterParameters::xrb());
    const HelicopterState state = after(world, 0.5);
    EXPECT_LT(state.world_from_body.translation.head<2>().norm(), 0.05);
    EXPECT_NEAR(state.world_from_body.translation.z(), 0.06, 0.005);
    EXPECT_LT(std::abs(yawOf(state.world_from_body.rotation)), 0.21);
    EXPECT_FALSE(world.verdict().crashed);
    EXPECT_FALSE(world.verdict().has_flown);
  }
}

TEST(World, InterpolatesBetweenItsSteps) {
  World world(seeded(5), HelicopterParameters::xrb());
  world.command(throttle(kHop), fromSeconds(0.3));
  world.advanceTo(fromSeconds(1.2));
  for (int ms = 1000; ms < 1190; ++ms) {
    const auto at = [&](double fraction) {
      return *world.at(ms * kNanosecondsPerMillisecond +
                       static_cast<TimeNs>(fraction * static_cast<double>(kNanosecondsPerMillisecond)));
    };
    const auto a = at(0.0).state, b = at(1.0).state, m = at(0.25).state;
    const auto mixed = [](const Eigen::Vector3d& x, const Eigen::Vector3d& y) -> Eigen::Vector3d {
      return 0.75 * x + 0.25 * y;
    };
    EXPECT_LT(
        (m.world_from_body.translation - mixed(a.world_from_body.translation, b.world_from_body.translation))
            .norm(),
        1e-12);
    EXPECT_LT((m.velocity_in_world - mixed(a.velocity_in_world, b.velocity_in_world)).norm(), 1e-12);
    EXPECT_NEAR(a.world_from_body.rotation.angularDistance(m.world_from_body.rotation),
                0.25 * a.world_from_body.rotation.angularDistance(b.world_from_body.rotation), 1e-7);
    EXPECT_LT((b.world_from_body.translation - a.world_from_body.translation).norm(), 0.005) << "moves on";
  }
}

TEST(World, RemembersAQuarterOfASecond) {
  World world(seeded(5), HelicopterParameters::xrb());
  world.command(throttle(kHop), fromSeconds(0.3));
  const Eigen::Vector3d then = after(world, 1.0).world_from_body.translation;
  world.advanceTo(fromSeconds(1.25));
  EXPECT_LT((world.at(fromSeconds(1.0))->state.world_from_body.translation - then).norm(), 1e-12);
}

TEST(World, SticksActAtTheirTime) {
  World early(seeded(1), HelicopterParameters::xrb()), late(seeded(1), HelicopterParameters::xrb());
  early.command(throttle(0.8), fromSeconds(0.6));
  late.command(throttle(0.8), fromSeconds(0.7));
  for (World* world : {&early, &late}) world->advanceTo(fromSeconds(0.8));
  const auto turned = [](const World& world, double t) {
    return world.at(fromSeconds(t))->upper_rotor_angle;
  };
  EXPECT_EQ(turned(early, 0.599), turned(early, 0.6));
  EXPECT_NE(turned(early, 0.61), turned(early, 0.6));
  EXPECT_EQ(turned(late, 0.699), turned(late, 0.6));
  EXPECT_NE(turned(late, 0.71), turned(late, 0.6));
}

TEST(World, RotorsTurnAgainstEachOther) {
  World world(seeded(1), HelicopterParameters::xrb());
  world.command(throttle(0.5), fromSeconds(0.3));
  world.advanceTo(fromSeconds(0.32));
  EXPECT_GT(world.at(fromSeconds(0.32))->upper_rotor_angle, 0.0);
  EXPECT_LT(world.at(fromSeconds(0.32))->lower_rotor_angle, 0.0);
}

TEST(World, TippingOverIsACrash) {
  HelicopterParameters lopsided = HelicopterParameters::xrb();
  lopsided.thrust_offset_y = 0.1;
  World world(seeded(2), lopsided);
  world.command(throttle(1.1), fromSeconds(0.3));
  world.advanceTo(fromSeconds(10.0));
  EXPECT_TRUE(world.verdict().crashed);
  EXPECT_STREQ(world.verdict().reason, "tipped over");
  EXPECT_GT(world.verdict().crash_time_s, 0.3);
  EXPECT_FALSE(world.verdict().at_rest);
  const auto wreck = after(world, 10.0);
  EXPECT_EQ(after(world, 12.0).world_from_body.translation, wreck.world_from_body.translation)
      << "lies still";
}

TEST(World, HardLandingIsACrash) {
  SimulationOptions options = seeded(2);
  options.gust_factor = 0.0;
  World world(options, HelicopterParameters::xrb());
  world.command(throttle(kHop), fromSeconds(0.3));
  world.command(throttle(0.0), fromSeconds(1.0));
  world.advanceTo(fromSeconds(5.0));
  EXPECT_TRUE(world.verdict().has_flown);
  EXPECT_STREQ(world.verdict().reason, "hit the ground");
  EXPECT_GT(world.verdict().hardest_touch, 1.0);
}

TEST(World, RestsOnlyWithRotorsAlmostStill) {
  World world(seeded(2), HelicopterParameters::xrb());
  world.command(throttle(0.7), fromSeconds(0.3));
  world.advanceTo(fromSeconds(2.0));
  EXPECT_FALSE(world.verdict().at_rest);
  world.command({}, fromSeconds(2.1));
  world.advanceTo(fromSeconds(4.0));
  EXPECT_TRUE(world.verdict().at_rest);
  EXPECT_FALSE(world.verdict().crashed);
}

TEST(World, LeavingTheFieldIsACrash) {
  World world(seeded(2), HelicopterParameters::xrb());
  world.command(throttle(1.5), fromSeconds(0.3));
  world.advanceTo(fromSeconds(3.0));
  EXPECT_STREQ(world.verdict().reason, "left the field upwards");
}

TEST(World, GustsMoveWhatFlies) {
  SimulationOptions calm = seeded(6), windy = seeded(6);
  calm.gust_factor = 0.0;
  windy.gust_factor = 2.0;
  World a(calm, HelicopterParameters::xrb()), b(windy, HelicopterParameters::xrb());
  for (World* world : {&a, &b}) world->command(throttle(kHop), fromSeconds(0.3));
  EXPECT_GT((after(a, 1.2).world_from_body.translation - after(b, 1.2).world_from_body.translation).norm(),
            1e-4);
}

TEST(World, AnOrderedGustPushesItsWayAndEnds) {
  SimulationOptions calm = seeded(6);
  calm.gust_factor = 0.0;
  World still(calm, HelicopterParameters::xrb()), pushed(calm, HelicopterParameters::xrb());
  for (World* world : {&still, &pushed}) world->command(throttle(kHop), fromSeconds(0.3));
  after(still, 0.9), after(pushed, 0.9);
  pushed.gust({2.0, 0.0, 0.0}, 0.2);
  const auto drift = [&](double time_s) {
    return after(pushed, time_s).velocity_in_world.x() - after(still, time_s).velocity_in_world.x();
  };
  EXPECT_LT(std::abs(drift(0.901)), 1e-3) << "it swells";
  EXPECT_GT(drift(1.1), 0.02);
}

TEST(World, AKnockMovesOneCameraFromWhereverItIs) {
  World world(seeded(6), HelicopterParameters::xrb());
  RigidTransform pose;
  pose.translation = {0.1, -0.2, 2.5};
  EXPECT_EQ(world.knocked(cameraId(1), pose).translation, pose.translation);
  world.knock(cameraId(1), 0.1, 0.05);
  EXPECT_EQ(world.knocked(cameraId(0), pose).translation, pose.translation) << "another camera";
  const RigidTransform once = world.knocked(cameraId(1), pose);
  EXPECT_NEAR(once.rotation.angularDistance(pose.rotation), 0.1, 1e-9);
  EXPECT_NEAR((once.inverseTranslation() - pose.inverseTranslation()).norm(), 0.05, 1e-9);
  world.knock(cameraId(1), 0.2, 0.0);
  EXPECT_NEAR(world.knocked(cameraId(1), pose).rotation.angularDistance(once.rotation), 0.2, 1e-9);
}

}  // namespace
}  // namespace helical
