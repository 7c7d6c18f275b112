#include "engine/flight/autopilot.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/rotation.h"

namespace helical {
namespace {

constexpr double kSpinUpThrottle = 0.75;   // of hover trim
constexpr double kSpinUpTime = 1.2;        // s
constexpr double kThrottleRamp = 0.25;     // hover trims per second until it lifts off
constexpr double kSlowTurn = 0.3;          // rad/s, above which the throttle waits for the yaw trim
constexpr double kHighestThrottle = 1.6;   // hover trims: a helicopter that does not lift by then never will
constexpr double kAirborneHeight = 0.025;  // m above the pad
constexpr double kIntegrateHeight =
    0.05;  // m: nearer the ground the skids hold it, integrators would wind up
constexpr double kTouchdownHeight = 0.03;      // m
constexpr double kTouchdownReference = -0.02;  // m: the reference is under the ground by then
constexpr double kSpinDownRate = 0.5;          // rotor fraction per second
constexpr double kSettleTime = 1.0;            // s on the ground, after which the rotors may stop at once
constexpr double kFadeTime = 0.15;             // s: feedback without a pose, to trim
constexpr double kSinkTime = 0.5;              // s until the open-loop descent has its speed
constexpr double kSinkThrust = -0.022;         // rotor fraction; a tenth of the weight
constexpr double kHoldSinkThrust = -0.006;     // what the rotors' damping carries at that speed
constexpr double kFadeThrust = 0.05;           // rotor fraction per second
constexpr double kOrderLasts =
    5.0;                            // s beyond the plan's delay: an older take-off order is refused, not kept
constexpr double kPadRadius = 0.5;  // m, within which it may start
constexpr double kPadTolerance = 0.06;    // m, of its height above the ground
constexpr double kStartTilt = 0.2;        // rad
constexpr double kStartSpeed = 0.15;      // m/s
constexpr double kLongestLiftOff = 20.0;  // s
constexpr double kStillSpeed = 0.05;      // m/s
constexpr double kStillTime = 1.5;        // s: what no longer sinks has landed, on whatever
constexpr double kOldPad = 0.05;          // s: a fresher pose measures the pad's height

}  // namespace

Autopilot::Autopilot(const FlightPlan& plan, const ControllerOptions& control,
                     const SupervisorOptions& safety, const HelicopterParameters& nominal)
    : control_(control),
      safety_options_(safety),
      controller_(control, nominal),
      follower_(plan),
      standing_height_(nominal.standing_height),
      pad_height_(nominal.standing_height) {}

void Autopilot::setControl(const ControllerOptions& control) {
  const ControllerOptions before = control_;
  control_ = control;
  control_.rate_hz = before.rate_hz;
  control_.output_delay_s = before.output_delay_s;
  controller_.setOptions(control_);
}

double Autopilot::flightTime(TimeNs now) const {
  return phase_ == FlightPhase::kIdle ? 0.0 : toSeconds(now - started_);
}

void Autopilot::enter(FlightPhase phase, TimeNs now) {
  phase_ = phase;
  phase_since_ = now;
}

AutopilotOutput Autopilot::step(const AutopilotInput& input) {
  const Eigen::Vector3d& position = input.state.world_from_body.translation;
  const double height = position.z() - pad_height_;
  if (input.commands.take_off) ordered_at_ = input.now;
  take_off_pending_ = (take_off_pending_ || input.commands.take_off) && !input.commands.land;
  refusal_ = nullptr;

  SupervisorConditions conditions;
  conditions.now = input.now;
  conditions.phase = phase_;
  conditions.pose_age_s = input.pose_age_s;
  conditions.tilt = tiltOf(input.state.world_from_body.rotation);
  conditions.distance_from_pad = position.head<2>().norm();
  conditions.height_above_pad = height;
  conditions.flight_time_s = flightTime(input.now);
  conditions.lift_off_failed =
      phase_ == FlightPhase::kLiftOff &&
      (throttle_ > kHighestThrottle || toSeconds(input.now - phase_since_) > kLongestLiftOff);
  conditions.kill = input.commands.kill;
  supervisor_ = supervise(safety_options_, supervisor_, conditions);

  AutopilotOutput output;
  if (supervisor_.state == SafetyState::kCut) {
    if (phase_ != FlightPhase::kIdle) enter(FlightPhase::kOff, input.now);
  } else {
    advance(input, height);
    output.sticks = act(input, height);
  }
  output.phase = phase_;
  output.safety = supervisor_.state;
  output.failsafes = supervisor_.failsafes;
  output.set_point = follower_.setPoint();
  if (phase_ < FlightPhase::kFlying) {
    output.set_point.position_in_world = position;
    output.set_point.yaw = yawOf(input.state.world_from_body.rotation);
  }
  output.pad_height = pad_height_;
  if (phase_ == FlightPhase::kIdle) output.obstacle = startObstacle(input);
  output.refusal = refusal_;
  output.airborne = inTheAir(phase_);
  output.hovering = phase_ == FlightPhase::kFlying && follower_.atFirstWaypoint();
  return output;
}

void Autopilot::advance(const AutopilotInput& input, double height) {
  const double in_phase = toSeconds(input.now - phase_since_);
  switch (phase_) {
    case FlightPhase::kIdle:
      awaitStart(input);
      return;
    case FlightPhase::kSpinUp:
      if (input.commands.land)
        enter(FlightPhase::kTouchdown, input.now);
      else if (throttle_ >= kSpinUpThrottle)
        enter(FlightPhase::kLiftOff, input.now);
      return;
    case FlightPhase::kLiftOff:
      if (input.commands.land) {
        enter(FlightPhase::kTouchdown, input.now);
      } else if (height > kAirborneHeight) {
        controller_.liftOff(throttle_);
        SetPoint here;
        here.position_in_world = input.state.world_from_body.translation;
        here.yaw = yawOf(input.state.world_from_body.rotation);
        follower_.start(here, pad_height_);
        enter(FlightPhase::kFlying, input.now);
      }
      return;
    case FlightPhase::kFlying: {
      const bool time_to_land =
          follower_.plan().land_at_s > 0.0 && flightTime(input.now) >= follower_.plan().land_at_s;
      const bool ordered = input.commands.land || supervisor_.state == SafetyState::kLandNow;
      if (ordered) follower_.resetTo(input.state.world_from_body.translation);
      if (time_to_land || ordered || (follower_.plan().land_at_s <= 0.0 && follower_.finished()))
        enter(FlightPhase::kLanding, input.now);
      return;
    }
    case FlightPhase::kLanding:
      if (hasTouchedDown(input, height)) enter(FlightPhase::kTouchdown, input.now);
      return;
    case FlightPhase::kTouchdown:
      if (rotors_off_ || (height < 0.005 && in_phase > kSettleTime)) enter(FlightPhase::kOff, input.now);
      return;
    case FlightPhase::kOff:
      return;
  }
}

const char* Autopilot::startObstacle(const AutopilotInput& input) const {
  const RigidTransform& pose = input.state.world_from_body;
  if (!input.pose_known || input.pose_age_s > kOldPad) return "the helicopter is not seen";
  if (pose.translation.head<2>().norm() > kPadRadius ||
      std::abs(pose.translation.z() - standing_height_) > kPadTolerance)
    return "it does not stand on the pad";
  if (tiltOf(pose.rotation) > kStartTilt) return "it does not stand upright";
  if (input.state.velocity_in_world.norm() > kStartSpeed) return "it moves";
  return nullptr;
}

void Autopilot::awaitStart(const AutopilotInput& input) {
  const char* obstacle = startObstacle(input);
  if (obstacle != nullptr) {
    seen_since_ = -1;
  } else {
    if (seen_since_ < 0) seen_since_ = input.now;
    pad_height_ = input.state.world_from_body.translation.z();
  }
  if (!take_off_pending_) return;
  if (obstacle != nullptr || toSeconds(input.now - seen_since_) < follower_.plan().start_delay_s) {
    // An order that waited long must not start the rotors of a helicopter that somebody is just carrying
    // back.
    if (obstacle == nullptr || toSeconds(input.now - ordered_at_) < kOrderLasts) return;
    take_off_pending_ = false;
    refusal_ = obstacle;
    return;
  }
  take_off_pending_ = false;
  started_ = input.now;
  controller_.reset();
  throttle_ = 0.0;
  rotors_off_ = false;
  enter(FlightPhase::kSpinUp, input.now);
}

bool Autopilot::hasTouchedDown(const AutopilotInput& input, double height) {
  const double vertical_speed = input.state.velocity_in_world.z();
  const double reference = follower_.setPoint().position_in_world.z() - pad_height_;
  if (height < kTouchdownHeight && vertical_speed > -0.15 && reference < kTouchdownReference) return true;
  if (!follower_.atLowerEnd() || std::abs(vertical_speed) > kStillSpeed) {
    still_since_ = -1;
    return false;
  }
  if (still_since_ < 0) still_since_ = input.now;
  return toSeconds(input.now - still_since_) > kStillTime;
}

StickDemand Autopilot::act(const AutopilotInput& input, double height) {
  const double dt = 1.0 / control_.rate_hz;
  const bool blind = input.pose_age_s > safety_options_.coast_after_s;
  switch (phase_) {
    case FlightPhase::kIdle:
    case FlightPhase::kOff:
      return {};
    case FlightPhase::kSpinUp:
      if (!blind) throttle_ = std::min(kSpinUpThrottle, throttle_ + kSpinUpThrottle / kSpinUpTime * dt);
      return controller_.onGround(input.state, throttle_, dt);
    case FlightPhase::kLiftOff:
      // The skids let go before the torques balance: turning slowly there teaches the yaw trim, spinning does
      // not. A lift-off that nobody sees is not driven on.
      if (!blind && std::abs(input.state.angular_velocity_in_body.z()) < kSlowTurn)
        throttle_ += kThrottleRamp * dt;
      return controller_.onGround(input.state, throttle_, dt);
    case FlightPhase::kFlying:
    case FlightPhase::kLanding: {
      if (was_blind_ && !blind) follower_.resetTo(input.state.world_from_body.translation);
      was_blind_ = blind;
      return blind ? flyBlind(input) : flySighted(input, height);
    }
    case FlightPhase::kTouchdown: {
      StickDemand sticks;
      rotors_off_ = controller_.spinDown(kSpinDownRate, dt, sticks);
      return sticks;
    }
  }
  return {};
}

StickDemand Autopilot::flySighted(const AutopilotInput& input, double height) {
  const double dt = 1.0 / control_.rate_hz;
  follower_.step(dt, input.state.world_from_body.translation, phase_ == FlightPhase::kLanding);
  Controller::FlyOptions options;
  options.integrate_position = height > kIntegrateHeight;
  return controller_.fly(input.state, follower_.setPoint(), options, dt);
}

StickDemand Autopilot::flyBlind(const AutopilotInput& input) {
  // The model knows the next tenth of a second; feedback on a longer prediction is worse than none.
  Controller::FlyOptions options;
  options.integrate_position = false;
  options.feedback =
      std::min(0.999, std::exp(-(input.pose_age_s - safety_options_.coast_after_s) / kFadeTime));
  if (supervisor_.state == SafetyState::kDescending) {
    // Open loop: sink to the descent speed, hold it against the rotors' damping, and fade the thrust once it
    // should be down.
    const double since = toSeconds(input.now - supervisor_.descending_since);
    const double down = supervisor_.descent_s - kSettleOnSkids;
    options.extra_thrust = since < kSinkTime ? kSinkThrust : kHoldSinkThrust;
    if (since > down) options.extra_thrust -= kFadeThrust * (since - down);
  }
  return controller_.fly(input.state, follower_.setPoint(), options, 1.0 / control_.rate_hz);
}

}  // namespace helical
