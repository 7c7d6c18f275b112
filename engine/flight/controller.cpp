#include "engine/flight/controller.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/rotation.h"

namespace helical {
namespace {

constexpr double kYawIntegralLimit = 0.4;
constexpr double kHeightIntegralLimit = 0.35;
// Of the observer of the thrust that carries it: acceleration per rotor fraction [m/s^2], bandwidth [rad/s].
constexpr double kLift = 45.0, kHoverBandwidth = 3.0;
constexpr double kLowestThrust = -0.2, kHighestThrust = 0.3;

}  // namespace

Controller::Controller(const ControllerOptions& options, const HelicopterParameters& nominal)
    : options_(options),
      trim_upper_(nominal.hoverStickUpper()),
      trim_lower_(nominal.hoverStickLower()),
      upper_time_(nominal.upper.motor_time),
      lower_time_(nominal.lower.motor_time) {
  const double upper = nominal.hoverSpeedUpper() * nominal.upper.motor_gain;
  const double lower = nominal.hoverSpeedLower() * nominal.lower.motor_gain;
  const double torque_upper = nominal.upper.drag_coefficient * upper;
  const double torque_lower = nominal.lower.drag_coefficient * lower;
  thrust_upper_ = 2.0 * torque_lower / (torque_upper + torque_lower);
  thrust_lower_ = 2.0 * torque_upper / (torque_upper + torque_lower);
  const double lift_upper = nominal.upper.thrust_coefficient * upper;
  const double lift_lower = nominal.lower.thrust_coefficient * lower;
  yaw_upper_ = 2.0 * lift_lower / (lift_upper + lift_lower);
  yaw_lower_ = 2.0 * lift_upper / (lift_upper + lift_lower);
}

void Controller::reset() {
  base_ = thrust_ = height_integral_ = yaw_integral_ = 0.0;
  hover_thrust_ = thrust_of_motors_ = climb_expected_ = 0.0;
  position_integral_.setZero();
  lag_known_ = false;
}

StickDemand Controller::onGround(const HelicopterState& state, double throttle, double dt) {
  base_ = throttle;
  const double yaw_rate = state.angular_velocity_in_body.z();
  yaw_integral_ = std::clamp(yaw_integral_ - options_.ground_yaw_i * yaw_rate * dt, -kYawIntegralLimit,
                             kYawIntegralLimit);
  const Eigen::Matrix2d heading =
      Eigen::Rotation2Dd(-yawOf(state.world_from_body.rotation)).toRotationMatrix();
  const Eigen::Vector2d tilt =
      heading * (state.world_from_body.rotation * Eigen::Vector3d::UnitZ()).head<2>();
  const Eigen::Vector2d velocity = heading * state.velocity_in_world.head<2>();
  const Eigen::Vector2d swash = -0.5 * options_.tilt * tilt - 0.5 * options_.position_d * velocity;
  return mix(0.0, yaw_integral_ - options_.ground_yaw_d * yaw_rate, swash, false, dt);
}

void Controller::liftOff(double throttle, double climb, double ramp) {
  base_ = throttle;
  thrust_ = height_integral_ = thrust_of_motors_ = 0.0;
  climb_expected_ = climb;
  // Thrust that grows by r per second lifts it to r t^2 / 2 and is by then r t too much.
  const double thrust_ramp = ramp * trim_lower_;
  hover_thrust_ = -std::sqrt(2.0 * thrust_ramp * std::max(0.0, climb) / kLift);
}

/// The throttle at which it left the ground lifts more than the weight, and the height's integral takes seconds to find
/// out: blind in the climb it would go on up.
void Controller::learnHoverThrust(double climb, double dt) {
  thrust_of_motors_ += (1.0 - std::exp(-dt / lower_time_)) * (thrust_ - thrust_of_motors_);
  const double surprise = climb - climb_expected_;
  climb_expected_ += dt * (kLift * (thrust_of_motors_ - hover_thrust_) + 2.0 * kHoverBandwidth * surprise);
  hover_thrust_ -= dt * kHoverBandwidth * kHoverBandwidth / kLift * surprise;
}

StickDemand Controller::fly(const HelicopterState& state, const SetPoint& set_point, const FlyOptions& fly,
                            double dt) {
  const bool sighted = fly.feedback >= 1.0;
  const double yaw = yawOf(state.world_from_body.rotation);
  const Eigen::Matrix2d heading = Eigen::Rotation2Dd(-yaw).toRotationMatrix();

  const double height_error = set_point.position_in_world.z() - state.world_from_body.translation.z();
  if (sighted && fly.integrate_position) {
    learnHoverThrust(state.velocity_in_world.z(), dt);
  } else {
    thrust_of_motors_ = thrust_;
    climb_expected_ = state.velocity_in_world.z();
  }
  if (sighted)
    height_integral_ = std::clamp(height_integral_ + options_.height_i * height_error * dt,
                                  -kHeightIntegralLimit, kHeightIntegralLimit);
  const double thrust =
      std::clamp(options_.height_p * height_error +
                     options_.height_d * (set_point.velocity_in_world.z() - state.velocity_in_world.z()) +
                     height_integral_,
                 kLowestThrust, kHighestThrust);
  thrust_ = hover_thrust_ + (thrust - hover_thrust_) * fly.feedback + fly.extra_thrust;

  // A bounded turn towards the heading, and the turn's error to the rotors: spinning is stopped before a
  // heading is sought.
  const double turn = std::clamp(options_.yaw_p * wrapAngle(set_point.yaw - yaw), -options_.yaw_rate_limit,
                                 options_.yaw_rate_limit);
  const double turn_error = turn - state.angular_velocity_in_body.z();
  if (sighted)
    yaw_integral_ =
        std::clamp(yaw_integral_ + options_.yaw_i * turn_error * dt, -kYawIntegralLimit, kYawIntegralLimit);
  const double yaw_demand = yaw_integral_ + options_.yaw_d * turn_error * fly.feedback;

  Eigen::Vector2d error =
      heading * (set_point.position_in_world - state.world_from_body.translation).head<2>();
  if (sighted && fly.integrate_position) {
    position_integral_ += options_.position_i * dt * error;
    position_integral_ *=
        std::min(1.0, options_.position_i_limit / std::max(position_integral_.norm(), 1e-9));
  }
  error *= std::min(1.0, options_.position_error_limit / std::max(error.norm(), 1e-9));
  const Eigen::Vector2d drift = heading * (state.velocity_in_world - set_point.velocity_in_world).head<2>();
  const Eigen::Vector2d tilt =
      heading * (state.world_from_body.rotation * Eigen::Vector3d::UnitZ()).head<2>();
  const Eigen::Vector2d feedback =
      options_.position_p * error - options_.position_d * drift - options_.tilt * tilt;
  return mix(thrust_, yaw_demand, position_integral_ + feedback * fly.feedback, true, dt);
}

bool Controller::spinDown(double rate, double dt, StickDemand& demand) {
  // However hard it was braking: what stands on its skids is not to hop.
  thrust_ = std::min(thrust_, hover_thrust_) - rate * dt;
  position_integral_ *= std::exp(-2.0 * dt);
  demand = mix(thrust_, yaw_integral_, position_integral_, true, dt);
  return base_ * trim_lower_ + thrust_ < 0.1;
}

StickDemand Controller::mix(double thrust, double yaw, const Eigen::Vector2d& swash_in_body, bool lead,
                            double dt) {
  double upper = thrust * thrust_upper_ - yaw * yaw_upper_;
  const double lower = thrust * thrust_lower_ + yaw * yaw_lower_;
  if (lead) {
    // (T_upper s + 1) / (T_lower s + 1): both rotors then answer as the lower one, and thrust does not turn
    // it.
    if (!lag_known_) lag_ = upper;
    lag_known_ = true;
    const double keep = std::exp(-dt / lower_time_);
    lag_ = keep * lag_ + (1.0 - keep) * upper;
    upper = lag_ + upper_time_ / lower_time_ * (upper - lag_);
  }
  const Eigen::Vector2d turned = Eigen::Rotation2Dd(options_.phase) * swash_in_body;
  const Eigen::Vector2d swash = turned / std::max(1.0, turned.norm());
  StickDemand demand;
  // The operator's trims fade in with the throttle: standing rotors stay standing.
  const double throttle = std::clamp(base_, 0.0, 1.0);
  demand.upper_rotor = std::clamp(base_ * trim_upper_ + upper + throttle * options_.trim_upper, 0.0, 1.0);
  demand.lower_rotor = std::clamp(base_ * trim_lower_ + lower + throttle * options_.trim_lower, 0.0, 1.0);
  demand.roll = std::clamp(options_.trim_roll - swash.y(), -1.0, 1.0);
  demand.pitch = std::clamp(options_.trim_pitch + swash.x(), -1.0, 1.0);
  return demand;
}

}  // namespace helical
