#include "engine/flight/controller.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/base/random.h"
#include "engine/geometry/rotation.h"

namespace helical {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kTick = 1.0 / 60.0;
const Controller::FlyOptions kFull{};
const Controller::FlyOptions kTrimsAlone{.integrate_position = false, .feedback = 0.0, .extra_thrust = 0.0};

HelicopterParameters nominal() {
  return HelicopterParameters::xrb();
}

/// Swash plate in line with the body: signs are easier to see.
ControllerOptions straight() {
  ControllerOptions options;
  options.phase = 0.0;
  return options;
}

Controller hovering(const ControllerOptions& options) {
  Controller controller(options, nominal());
  controller.liftOff(1.0);
  return controller;
}

HelicopterState stateAt(const Vector3d& position, double yaw = 0.0) {
  HelicopterState state;
  state.world_from_body = {expSO3({0, 0, yaw}), position};
  return state;
}

SetPoint setPointAt(const Vector3d& position, double yaw = 0.0) {
  SetPoint set_point;
  set_point.position_in_world = position;
  set_point.yaw = yaw;
  return set_point;
}

StickDemand first(const HelicopterState& state, const SetPoint& set_point,
                  const ControllerOptions& options = straight()) {
  return hovering(options).fly(state, set_point, kFull, kTick);
}

StickDemand after(Controller& controller, double seconds, const HelicopterState& state,
                  const SetPoint& set_point, const Controller::FlyOptions& fly) {
  StickDemand demand;
  for (int i = 0; i < static_cast<int>(seconds / kTick); ++i)
    demand = controller.fly(state, set_point, fly, kTick);
  return demand;
}

TEST(Controller, HoversOnTheTrims) {
  const StickDemand demand = first({}, {});
  EXPECT_NEAR(demand.upper_rotor, nominal().hoverStickUpper(), 1e-9);
  EXPECT_NEAR(demand.lower_rotor, nominal().hoverStickLower(), 1e-9);
  EXPECT_NEAR(demand.roll, 0.0, 1e-9);
  EXPECT_NEAR(demand.pitch, 0.0, 1e-9);
}

TEST(Controller, TipsTheThrustTowardsTheSetPoint) {
  for (const double yaw : {0.0, 1.0, -2.5}) {
    const Eigen::Quaterniond turned = expSO3({0, 0, yaw});
    const auto towards = [&](const Vector3d& body) {
      return first(stateAt(Vector3d::Zero(), yaw), setPointAt(turned * body, yaw));
    };
    EXPECT_GT(towards({0.1, 0, 0}).pitch, 0.1);
    EXPECT_NEAR(towards({0.1, 0, 0}).roll, 0.0, 1e-9);
    EXPECT_LT(towards({-0.1, 0, 0}).pitch, -0.1);
    EXPECT_LT(towards({0, 0.1, 0}).roll, -0.1) << "positive roll tips the thrust to the right";
    EXPECT_NEAR(towards({0, 0.1, 0}).pitch, 0.0, 1e-9);
    EXPECT_GT(towards({0, -0.1, 0}).roll, 0.1);
  }
}

TEST(Controller, TurnsTheSwashPlateByThePhaseAngle) {
  ControllerOptions options = straight();
  options.phase = 0.3;
  const StickDemand demand = first({}, setPointAt({0.1, 0, 0}), options);
  EXPECT_NEAR(std::atan2(-demand.roll, demand.pitch), 0.3, 1e-9);
}

TEST(Controller, BrakesAndLevels) {
  HelicopterState moving;
  moving.velocity_in_world = {0.2, -0.1, 0.0};
  EXPECT_LT(first(moving, {}).pitch, 0.0);
  EXPECT_LT(first(moving, {}).roll, 0.0);
  HelicopterState nose_down;
  nose_down.world_from_body.rotation = expSO3({0, 0.1, 0});
  EXPECT_LT(first(nose_down, {}).pitch, 0.0);
  HelicopterState right_down;
  right_down.world_from_body.rotation = expSO3({0.1, 0, 0});
  EXPECT_LT(first(right_down, {}).roll, 0.0);
}

TEST(Controller, DoesNotBrakeForAMovingSetPoint) {
  HelicopterState moving;
  moving.velocity_in_world = {0.2, 0.0, 0.1};
  SetPoint along;
  along.velocity_in_world = moving.velocity_in_world;
  const StickDemand demand = first(moving, along);
  EXPECT_NEAR(demand.pitch, 0.0, 1e-9);
  EXPECT_NEAR(demand.upper_rotor, nominal().hoverStickUpper(), 1e-9);
}

TEST(Controller, BothRotorsLift) {
  const StickDemand trim = first({}, {}), up = first({}, setPointAt({0, 0, 0.1}));
  EXPECT_GT(up.upper_rotor, trim.upper_rotor + 0.01);
  EXPECT_GT(up.lower_rotor, trim.lower_rotor + 0.01);
  HelicopterState climbing;
  climbing.velocity_in_world.z() = 0.2;
  EXPECT_LT(first(climbing, {}).upper_rotor, trim.upper_rotor);
  EXPECT_LT(first(climbing, {}).lower_rotor, trim.lower_rotor);
}

TEST(Controller, RotorsTurnItAgainstEachOther) {
  const StickDemand trim = first({}, {});
  const StickDemand left = first({}, setPointAt(Vector3d::Zero(), 0.3));
  EXPECT_LT(left.upper_rotor, trim.upper_rotor);
  EXPECT_GT(left.lower_rotor, trim.lower_rotor);
  HelicopterState spinning;
  spinning.angular_velocity_in_body.z() = 0.5;
  EXPECT_GT(first(spinning, {}).upper_rotor, trim.upper_rotor);
  EXPECT_LT(first(spinning, {}).lower_rotor, trim.lower_rotor);
}

TEST(Controller, TurnsTheShortWayAround) {
  const StickDemand demand = first(stateAt(Vector3d::Zero(), 3.0), setPointAt(Vector3d::Zero(), -3.0));
  EXPECT_GT(demand.lower_rotor, nominal().hoverStickLower());
}

/// Small changes of the rotors' speeds: torque about the shaft and lift, by the nominal coefficients.
double torqueOf(const StickDemand& d) {
  const HelicopterParameters p = nominal();
  const double upper = p.upper.drag_coefficient * p.hoverSpeedUpper() * p.upper.motor_gain;
  const double lower = p.lower.drag_coefficient * p.hoverSpeedLower() * p.lower.motor_gain;
  return lower * (d.lower_rotor - p.hoverStickLower()) - upper * (d.upper_rotor - p.hoverStickUpper());
}
double liftOf(const StickDemand& d) {
  const HelicopterParameters p = nominal();
  const double upper = p.upper.thrust_coefficient * p.hoverSpeedUpper() * p.upper.motor_gain;
  const double lower = p.lower.thrust_coefficient * p.hoverSpeedLower() * p.lower.motor_gain;
  return lower * (d.lower_rotor - p.hoverStickLower()) + upper * (d.upper_rotor - p.hoverStickUpper());
}

TEST(Controller, ThrustDoesNotTurnItAndYawDoesNotLiftIt) {
  ControllerOptions options = straight();
  options.height_i = options.yaw_i = 0.0;
  Controller lifting = hovering(options), turning = hovering(options);
  const StickDemand up = after(lifting, 5.0, {}, setPointAt({0, 0, 0.2}), kFull);
  EXPECT_GT(std::abs(liftOf(up)), 1e-4);
  EXPECT_LT(std::abs(torqueOf(up)), 1e-6 * std::abs(liftOf(up)));
  const StickDemand left = after(turning, 5.0, {}, setPointAt(Vector3d::Zero(), 0.4), kFull);
  EXPECT_GT(torqueOf(left), 1e-6);
  EXPECT_LT(std::abs(liftOf(left)), 1e-6 * torqueOf(left));
}

TEST(Controller, LeadPushesTheSlowUpperMotorOnlyAtFirst) {
  ControllerOptions options = straight();
  options.height_i = 0.0;
  Controller controller = hovering(options);
  const double trim = nominal().hoverStickUpper();
  after(controller, 1.0, {}, {}, kFull);
  const double pushed = controller.fly({}, setPointAt({0, 0, 0.1}), kFull, kTick).upper_rotor - trim;
  const double settled = after(controller, 3.0, {}, setPointAt({0, 0, 0.1}), kFull).upper_rotor - trim;
  EXPECT_GT(pushed, 1.2 * settled);
  EXPECT_GT(settled, 0.0);
}

TEST(Controller, IntegratorsAreBounded) {
  const ControllerOptions options;
  Controller controller = hovering(options);
  const SetPoint far = setPointAt({5, 5, 5}, 3.0);
  after(controller, 120.0, {}, far, kFull);
  const StickDemand trims = after(controller, 5.0, {}, {}, kTrimsAlone);
  EXPECT_NEAR(Vector2d(trims.roll, trims.pitch).norm(), options.position_i_limit, 1e-6);
  const StickDemand once_more = after(controller, 120.0, {}, far, kFull);
  EXPECT_LE(once_more.upper_rotor, 1.0);
  after(controller, 60.0, {}, setPointAt({0, 0, -0.5}), kFull);
  const StickDemand down = after(controller, 5.0, {}, {}, kTrimsAlone);
  EXPECT_GE(down.upper_rotor + down.lower_rotor, 0.0) << "unwinds";
  EXPECT_LT(down.upper_rotor, nominal().hoverStickUpper());
}

TEST(Controller, IntegratorsRestWithoutFeedback) {
  Controller controller = hovering({});
  after(controller, 1.0, {}, setPointAt({0.1, -0.1, 0.1}, 0.1), kFull);
  const StickDemand before = after(controller, 5.0, {}, {}, kTrimsAlone);
  EXPECT_NE(before.pitch, 0.0);
  Controller::FlyOptions half{.integrate_position = true, .feedback = 0.5, .extra_thrust = 0.0};
  after(controller, 20.0, {}, setPointAt({1, 1, 1}, 2.0), half);
  const StickDemand now = after(controller, 5.0, {}, {}, kTrimsAlone);
  EXPECT_NEAR(now.upper_rotor, before.upper_rotor, 1e-9);
  EXPECT_NEAR(now.lower_rotor, before.lower_rotor, 1e-9);
  EXPECT_NEAR(now.roll, before.roll, 1e-9);
  EXPECT_NEAR(now.pitch, before.pitch, 1e-9);
}

TEST(Controller, WithoutFeedbackStateAndSetPointDoNotMatter) {
  Controller a = hovering({}), b = hovering({});
  HelicopterState wild = stateAt({3, -2, 1}, 2.0);
  wild.velocity_in_world = {1, 2, 3};
  wild.angular_velocity_in_body = {1, 2, 3};
  const StickDemand calm = a.fly({}, {}, kTrimsAlone, kTick);
  EXPECT_EQ(calm, b.fly(wild, setPointAt({1, 1, 1}, 1.0), kTrimsAlone, kTick));
}

TEST(Controller, FeedbackFadesEvenly) {
  const SetPoint ahead = setPointAt({0.1, 0, 0});
  double last = 1.0;
  for (const double feedback : {0.9, 0.6, 0.3, 0.1}) {
    Controller controller = hovering(straight());
    const double pitch =
        controller
            .fly({}, ahead, {.integrate_position = false, .feedback = feedback, .extra_thrust = 0.0}, kTick)
            .pitch;
    EXPECT_NEAR(pitch, feedback * straight().position_p * 0.1, 1e-9);
    EXPECT_LT(pitch, last);
    last = pitch;
  }
}

TEST(Controller, NearTheGroundThePositionIsNotIntegrated) {
  Controller controller = hovering({});
  after(controller, 20.0, {}, setPointAt({0.5, 0.5, 0.0}),
        {.integrate_position = false, .feedback = 1.0, .extra_thrust = 0.0});
  const StickDemand trims = controller.fly({}, {}, kTrimsAlone, kTick);
  EXPECT_EQ(trims.roll, 0.0);
  EXPECT_EQ(trims.pitch, 0.0);
}

TEST(Controller, ExtraThrustSinks) {
  Controller controller = hovering({});
  const StickDemand sinking =
      after(controller, 2.0, {}, {}, {.integrate_position = false, .feedback = 0.0, .extra_thrust = -0.02});
  EXPECT_LT(sinking.upper_rotor, nominal().hoverStickUpper() - 0.01);
  EXPECT_LT(sinking.lower_rotor, nominal().hoverStickLower() - 0.01);
}

TEST(Controller, OnTheGroundTheThrottleIsAShareOfTheTrims) {
  for (const double throttle : {0.0, 0.3, 0.75, 1.2}) {
    Controller controller({}, nominal());
    const StickDemand demand = controller.onGround({}, throttle, kTick);
    EXPECT_NEAR(demand.upper_rotor, throttle * nominal().hoverStickUpper(), 1e-9);
    EXPECT_NEAR(demand.lower_rotor, throttle * nominal().hoverStickLower(), 1e-9);
  }
}

TEST(Controller, LearnsTheYawTrimOnTheGround) {
  Controller controller({}, nominal());
  HelicopterState turning;
  turning.angular_velocity_in_body.z() = 0.4;
  for (int i = 0; i < 60; ++i) controller.onGround(turning, 0.9, kTick);
  const StickDemand demand = controller.onGround({}, 0.9, kTick);
  EXPECT_GT(demand.upper_rotor, 0.9 * nominal().hoverStickUpper());
  EXPECT_LT(demand.lower_rotor, 0.9 * nominal().hoverStickLower());
  controller.reset();
  const StickDemand forgotten = controller.onGround({}, 0.9, kTick);
  EXPECT_NEAR(forgotten.upper_rotor, 0.9 * nominal().hoverStickUpper(), 1e-9);
}

TEST(Controller, SpinsDownSteadilyToOff) {
  Controller controller = hovering({});
  StickDemand demand = after(controller, 1.0, {}, {}, kFull);
  bool off = false;
  int ticks = 0;
  while (!off) {
    const StickDemand before = demand;
    off = controller.spinDown(0.5, kTick, demand);
    EXPECT_LE(demand.lower_rotor, before.lower_rotor);
    EXPECT_LE(demand.upper_rotor, before.upper_rotor);
    ASSERT_LT(++ticks, 120);
  }
  EXPECT_LT(demand.lower_rotor, 0.1);
}

TEST(Controller, SticksStayInTheirRangeWhateverTheState) {
  Random random(1);
  Controller controller = hovering({});
  for (int i = 0; i < 20000; ++i) {
    const auto vector = [&](double size) {
      return Vector3d(size * random.normal(), size * random.normal(), size * random.normal());
    };
    HelicopterState state;
    state.world_from_body = {expSO3(vector(1.0)), vector(2.0)};
    state.velocity_in_world = vector(2.0);
    state.angular_velocity_in_body = vector(5.0);
    SetPoint set_point = setPointAt(vector(1.0), random.uniform(-kPi, kPi));
    set_point.velocity_in_world = vector(1.0);
    const StickDemand d = random.uniform() < 0.3
                              ? controller.onGround(state, random.uniform(0.0, 1.6), kTick)
                              : controller.fly(state, set_point,
                                               {.integrate_position = random.uniform() < 0.8,
                                                .feedback = random.uniform() < 0.8 ? 1.0 : random.uniform(),
                                                .extra_thrust = 0.0},
                                               kTick);
    for (const double rotor : {d.upper_rotor, d.lower_rotor}) {
      ASSERT_GE(rotor, 0.0);
      ASSERT_LE(rotor, 1.0);
    }
    ASSERT_LE(Vector2d(d.roll, d.pitch).norm(), 1.0 + 1e-12);
  }
}

TEST(Controller, DoesNotHopWhenItTouchesDownWhileItBrakes) {
  Controller controller = hovering(straight());
  HelicopterState falling = stateAt({0, 0, 0.01});
  falling.velocity_in_world.z() = -0.9;
  const StickDemand braking = after(controller, 0.1, falling, setPointAt({0, 0, 0.0}), {.integrate_position = false});
  StickDemand down;
  controller.spinDown(0.5, kTick, down);
  EXPECT_GT(braking.lower_rotor, nominal().hoverStickLower() + 0.05);
  EXPECT_LT(down.lower_rotor, nominal().hoverStickLower());
}

}  // namespace
}  // namespace helical
