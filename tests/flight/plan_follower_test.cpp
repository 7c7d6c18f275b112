#include "engine/flight/plan_follower.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/base/random.h"
#include "engine/geometry/rotation.h"

namespace helical {
namespace {

using Eigen::Vector3d;

constexpr double kTick = 1.0 / 60.0;
constexpr double kPad = 0.06;
constexpr double kYawRate = 0.6;

SetPoint standing(const Vector3d& position = {0.0, 0.0, kPad + 0.03}, double yaw = 0.0) {
  SetPoint here;
  here.position_in_world = position;
  here.yaw = yaw;
  return here;
}

/// Follows the reference as a helicopter does that is held back by nothing.
struct Follow {
  PlanFollower follower;
  Vector3d position;
  explicit Follow(const FlightPlan& plan, const SetPoint& here = standing())
      : follower(plan), position(here.position_in_world) {
    follower.start(here, kPad);
  }
  SetPoint step(bool landing = false) {
    const SetPoint result = follower.step(kTick, position, landing);
    position += 0.3 * (result.position_in_world - position);
    return result;
  }
  void stepFor(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds / kTick); ++i) step();
  }
};

FlightPlan tour() {
  FlightPlan plan;
  plan.waypoints = {{{0.0, 0.0, 0.5}, 0.0, 0.5, 0.25},
                    {{0.4, -0.2, 0.8}, 1.0, 1.0, 0.3},
                    {{-0.3, 0.3, 0.4}, -2.5, 0.0, 0.2}};
  plan.land_at_s = 0.0;
  return plan;
}

TEST(PlanFollower, AChangedPlanIsFlownOnFromTheSameWaypoint) {
  Follow flight{tour()};
  flight.stepFor(4.5);  // on the way to the second
  const Vector3d before = flight.follower.setPoint().position_in_world;
  FlightPlan changed = tour();
  changed.waypoints[1].position_above_pad = {-0.4, 0.2, 0.8};
  flight.follower.swapPlan(changed);
  EXPECT_EQ(changed.waypoints[1].position_above_pad, tour().waypoints[1].position_above_pad) << "swapped";
  const SetPoint first = flight.step();
  EXPECT_LT((first.position_in_world - before).norm(), 0.3 * kTick + 1e-9) << "no jump";
  flight.stepFor(3.5);  // there, and held for a second
  EXPECT_NEAR(flight.follower.setPoint().position_in_world.x(), -0.4, 1e-9);
}

TEST(PlanFollower, AShorterPlanEndsAtItsLastWaypointALongerOneGoesOn) {
  Follow flight{tour()};
  flight.stepFor(30.0);
  ASSERT_TRUE(flight.follower.finished());
  FlightPlan longer = tour();
  longer.waypoints.push_back({{0.2, 0.0, 0.6}, 0.0, 0.0, 0.3});
  flight.follower.swapPlan(longer);
  EXPECT_FALSE(flight.follower.finished());
  flight.stepFor(10.0);
  EXPECT_TRUE(flight.follower.finished());
  EXPECT_NEAR(flight.follower.setPoint().position_in_world.x(), 0.2, 1e-9);

  FlightPlan one;
  flight.follower.swapPlan(one);
  flight.stepFor(10.0);
  EXPECT_NEAR(flight.follower.setPoint().position_in_world.x(), 0.0, 1e-9);
  EXPECT_TRUE(flight.follower.finished());
}

TEST(PlanFollower, ClimbsAtTheClimbSpeedToTheFirstWaypoint) {
  Follow flight{FlightPlan{}};
  double last = flight.position.z();
  for (int i = 0; i < 600; ++i) {
    const SetPoint reference = flight.step();
    EXPECT_LE(reference.position_in_world.z() - last, 0.25 * kTick + 1e-12);
    EXPECT_GE(reference.position_in_world.z(), last);
    last = reference.position_in_world.z();
  }
  EXPECT_NEAR(last, kPad + 0.6, 1e-9);
  EXPECT_TRUE(flight.follower.atFirstWaypoint());
}

TEST(PlanFollower, WaitsForAHelicopterThatIsHeldBack) {
  PlanFollower follower{FlightPlan{}};
  follower.start(standing(), kPad);
  const Vector3d stuck(0, 0, kPad + 0.03);
  for (int i = 0; i < 600; ++i) follower.step(kTick, stuck, false);
  EXPECT_LT(follower.setPoint().position_in_world.z() - stuck.z(), 0.13);
  EXPECT_FALSE(follower.atFirstWaypoint());
}

/// A random helicopter on a random plan with gaps: the reference moves no faster than the plan says.
TEST(PlanFollower, ReferenceNeverJumps) {
  Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    FlightPlan plan;
    plan.waypoints.clear();
    for (int i = 0; i < 4; ++i)
      plan.waypoints.push_back({{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.2, 1.5)},
                                random.uniform(-3.1, 3.1),
                                random.uniform(0.0, 1.0),
                                random.uniform(0.1, 0.8)});
    plan.climb_speed = random.uniform(0.1, 0.5);
    double fastest = plan.climb_speed;
    for (const auto& waypoint : plan.waypoints) fastest = std::max(fastest, waypoint.speed);
    Follow flight{plan, standing({random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), kPad + 0.03},
                                 random.uniform(-3.1, 3.1))};
    SetPoint before = flight.follower.setPoint();
    for (int i = 0; i < 1500; ++i) {
      const bool landing = i > 1200;
      if (random.uniform() < 0.005) {
        const Vector3d blown = 0.1 * Vector3d(random.normal(), random.normal(), random.normal());
        flight.position += blown;
        flight.position.z() = std::max(flight.position.z(), kPad);
        flight.follower.resetTo(flight.position);
        before = flight.follower.setPoint();
      }
      const SetPoint now = flight.step(landing);
      const Vector3d way = now.position_in_world - before.position_in_world;
      const double limit = std::hypot(fastest, plan.climb_speed);
      ASSERT_LE(way.norm(), limit * kTick + 1e-9) << "trial " << trial << " tick " << i;
      ASSERT_LE(std::abs(wrapAngle(now.yaw - before.yaw)), kYawRate * kTick + 1e-9);
      ASSERT_LT((now.velocity_in_world - way / kTick).norm(), 1e-6) << "velocity is the reference's own";
      before = now;
    }
  }
}

TEST(PlanFollower, VisitsTheWaypointsInOrderAndHoldsThem) {
  const FlightPlan plan = tour();
  Follow flight{plan};
  std::size_t next = 0;
  double held = 0.0;
  for (int i = 0; i < 60 * 60 && !flight.follower.finished(); ++i) {
    const SetPoint reference = flight.step();
    Vector3d place = plan.waypoints[next].position_above_pad;
    place.z() += kPad;
    const bool there = (reference.position_in_world - place).norm() < 1e-9 &&
                       std::abs(wrapAngle(reference.yaw - plan.waypoints[next].yaw)) < 1e-9;
    if (there) held += kTick;
    if (!there && held > 0.0) {
      EXPECT_GE(held, plan.waypoints[next].hold_s);
      EXPECT_LT(held, plan.waypoints[next].hold_s + 5 * kTick);
      held = 0.0;
      ++next;
      ASSERT_LT(next, plan.waypoints.size());
    }
  }
  EXPECT_EQ(next, 2u);
  EXPECT_TRUE(flight.follower.finished());
}

TEST(PlanFollower, LeavesTheHeadingAloneUntilItIsOffTheGround) {
  FlightPlan plan;
  plan.waypoints[0].yaw = 1.0;
  PlanFollower follower(plan);
  follower.start(standing({0, 0, kPad + 0.03}, 0.2), kPad);
  for (int i = 0; i < 200; ++i) follower.step(kTick, {0, 0, kPad + 0.05}, false);
  EXPECT_EQ(follower.setPoint().yaw, 0.2);
  for (int i = 0; i < 60; ++i) follower.step(kTick, {0, 0, kPad + 0.15}, false);
  EXPECT_GT(follower.setPoint().yaw, 0.5);
}

TEST(PlanFollower, LandsBelowTheGroundAndSlowlyAtTheEnd) {
  const FlightPlan plan;
  Follow flight{plan};
  flight.stepFor(10.0);
  const Vector3d hover = flight.follower.setPoint().position_in_world;
  double last = hover.z();
  for (int i = 0; i < 600; ++i) {
    const double height = flight.position.z() - kPad;
    const SetPoint reference = flight.step(true);
    const double speed = (last - reference.position_in_world.z()) / kTick;
    EXPECT_LE(speed, (height < 0.12 ? plan.touchdown_speed : plan.descent_speed) + 1e-9);
    EXPECT_EQ(reference.position_in_world.head<2>(), hover.head<2>()) << "straight down";
    last = reference.position_in_world.z();
  }
  EXPECT_LT(last, kPad - 0.05) << "into the ground, so that it surely touches";
  EXPECT_GT(last, kPad - 0.5);
}

TEST(PlanFollower, GoesOnFromWhereTheHelicopterIsAfterAGap) {
  Follow flight{tour()};
  flight.stepFor(5.0);
  flight.position += Vector3d(0.2, 0.1, -0.1);
  flight.follower.resetTo(flight.position);
  EXPECT_EQ(flight.follower.setPoint().position_in_world, flight.position);
  EXPECT_EQ(flight.follower.setPoint().velocity_in_world, Vector3d::Zero());
  for (int i = 0; i < 60 * 60 && !flight.follower.finished(); ++i) flight.step();
  EXPECT_TRUE(flight.follower.finished());
}

}  // namespace
}  // namespace helical
