#include "engine/flight/autopilot.h"

#include <algorithm>
#include <cmath>

#include "engine/flight/fence.h"
#include "engine/flight/pre_arm.h"
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
constexpr double kSinkThrust = -0.022;         // rotor fraction; a tenth of the weight: kDescentAcceleration
constexpr double kHoldSinkThrust = -0.006;     // what the rotors' damping carries at that speed
constexpr double kFadeThrust = 0.03;           // rotor fraction per second
constexpr double kDriftTime = 0.3;             // s, of the smoothing of what should stand still
constexpr double kVelocityNoise = 0.1;         // m/s, of the pose of what stands still
constexpr double kUnknownDrift = 0.2;          // m/s, of what is not seen
constexpr double kLongestLiftOff = 20.0;       // s
constexpr double kFarthestOnSkids = 0.15;      // m, from where the rotors started
constexpr double kStillSpeed = 0.05;           // m/s
constexpr double kStillTime = 1.5;             // s: what no longer sinks has landed, on whatever

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

SupervisorConditions Autopilot::conditions(const AutopilotInput& input, double height) const {
  const RigidTransform& pose = input.state.world_from_body;
  SupervisorConditions c;
  c.now = input.now;
  c.phase = phase_;
  c.pose_known = input.pose_known;
  c.pose_age_s = input.pose_age_s;
  c.period_s = 1.0 / control_.rate_hz;
  c.climb = input.state.velocity_in_world.z();
  c.tilt = tiltOf(pose.rotation);
  c.speed = input.state.velocity_in_world.norm();
  c.drift = std::max(drift_.norm(), c.speed - kVelocityNoise);
  c.place << pose.translation.head<2>(), height;
  c.standing_error = pose.translation.z() - standing_height_;
  c.flight_time_s = flightTime(input.now);
  c.sticks_idle = sticks_ == StickDemand{};
  c.lift_off_failed = liftOffFails(input);
  c.arm = input.commands.arm;
  c.disarm = input.commands.disarm;
  c.kill = input.commands.kill;
  c.health = input.health;
  return c;
}

bool Autopilot::liftOffFails(const AutopilotInput& input) const {
  if (phase_ == FlightPhase::kLiftOff)
    return throttle_ > kHighestThrottle || toSeconds(input.now - phase_since_) > kLongestLiftOff;
  // Rotors that do not carry it yet cannot move it: it is the pose that is wrong.
  return phase_ == FlightPhase::kSpinUp && input.pose_age_s <= safety_options_.coast_after_s &&
         (input.state.world_from_body.translation - started_at_).norm() > kFarthestOnSkids;
}

void Autopilot::smoothDrift(const AutopilotInput& input) {
  if (!input.pose_known || input.pose_age_s > safety_options_.coast_after_s)
    drift_ = kUnknownDrift * Eigen::Vector3d::UnitX();
  const double share = 1.0 / (control_.rate_hz * kDriftTime);
  drift_ += std::min(1.0, share) * (input.state.velocity_in_world - drift_);
}

void Autopilot::obey(const OperatorCommands& commands) {
  refusal_ = nullptr;
  take_off_pending_ = (take_off_pending_ || commands.take_off) && !commands.land;
  holding_ = (holding_ || commands.hold) && !commands.take_off && !commands.land && inTheAir(phase_);
  if (phase_ != FlightPhase::kIdle) take_off_pending_ = false;
}

AutopilotOutput Autopilot::step(const AutopilotInput& input) {
  const Eigen::Vector3d& position = input.state.world_from_body.translation;
  const double height = position.z() - pad_height_;
  smoothDrift(input);
  obey(input.commands);
  supervisor_ = supervise(safety_options_, supervisor_, conditions(input, height));

  AutopilotOutput output;
  if (supervisor_.state == SafetyState::kCut) {
    if (phase_ != FlightPhase::kIdle) enter(FlightPhase::kOff, input.now);
  } else {
    advance(input, height);
    output.sticks = act(input, height);
  }
  sticks_ = output.sticks;
  output.phase = phase_;
  output.safety = supervisor_.state;
  output.failsafes = supervisor_.failsafes;
  output.alarms = supervisor_.alarms;
  output.armed = supervisor_.armed;
  output.failing_checks = supervisor_.failing_checks;
  output.arm_refused = supervisor_.refused;
  output.holding = holding_;
  output.set_point = follower_.setPoint();
  if (phase_ < FlightPhase::kFlying) {
    output.set_point.position_in_world = position;
    output.set_point.yaw = yawOf(input.state.world_from_body.rotation);
  }
  output.pad_height = pad_height_;
  if (phase_ == FlightPhase::kIdle)
    output.obstacle = firstReason(supervisor_.failing_checks & kStandingChecks);
  output.refusal = refusal_;
  output.airborne = inTheAir(phase_);
  output.hovering = phase_ == FlightPhase::kFlying && follower_.atFirstWaypoint();
  return output;
}

/// On the skids with fewer cameras than it takes to arm: it is not to leave the ground on the last one.
bool Autopilot::isBlocked(const AutopilotInput& input) {
  const bool enough = input.health.live_cameras >= safety_options_.arm_cameras;
  if (enough || few_since_ < 0) few_since_ = enough ? -1 : input.now;
  const bool on_skids = phase_ == FlightPhase::kSpinUp || phase_ == FlightPhase::kLiftOff;
  const bool blocked = on_skids && !enough && toSeconds(input.now - few_since_) > safety_options_.neutral_after_s;
  if (blocked) refusal_ = toString(PreArmCheck::kCameras);
  return blocked;
}

void Autopilot::advance(const AutopilotInput& input, double height) {
  const double in_phase = toSeconds(input.now - phase_since_);
  const bool ordered = isBlocked(input) || input.commands.land || supervisor_.state == SafetyState::kLandNow;
  switch (phase_) {
    case FlightPhase::kIdle:
      awaitStart(input);
      return;
    case FlightPhase::kSpinUp:
      if (ordered)
        enter(FlightPhase::kTouchdown, input.now);
      else if (throttle_ >= kSpinUpThrottle)
        enter(FlightPhase::kLiftOff, input.now);
      return;
    case FlightPhase::kLiftOff:
      if (ordered) {
        enter(FlightPhase::kTouchdown, input.now);
      } else if (height > kAirborneHeight) {
        controller_.liftOff(throttle_, input.state.velocity_in_world.z(), kThrottleRamp);
        SetPoint here;
        here.position_in_world = input.state.world_from_body.translation;
        here.yaw = yawOf(input.state.world_from_body.rotation);
        follower_.start(here, pad_height_);
        enter(FlightPhase::kFlying, input.now);
      }
      return;
    case FlightPhase::kFlying: {
      const FlightPlan& plan = follower_.plan();
      const bool time_to_land = plan.land_at_s > 0.0 && flightTime(input.now) >= plan.land_at_s;
      const bool done = time_to_land || (plan.land_at_s <= 0.0 && follower_.finished());
      if (ordered) follower_.resetTo(input.state.world_from_body.translation);
      if (ordered || (done && !holding_)) enter(FlightPhase::kLanding, input.now);
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

void Autopilot::awaitStart(const AutopilotInput& input) {
  const char* obstacle = firstReason(supervisor_.failing_checks & kStandingChecks);
  if (obstacle != nullptr) {
    seen_since_ = -1;
  } else {
    if (seen_since_ < 0) seen_since_ = input.now;
    pad_height_ = input.state.world_from_body.translation.z();
  }
  if (!take_off_pending_) return;
  if (!supervisor_.armed) {
    // An order that waited must not start the rotors of a helicopter that somebody is just carrying back.
    take_off_pending_ = false;
    refusal_ = obstacle != nullptr ? obstacle : "it is not armed";
    return;
  }
  if (obstacle != nullptr || toSeconds(input.now - seen_since_) < follower_.plan().start_delay_s) return;
  take_off_pending_ = false;
  started_ = input.now;
  started_at_ = input.state.world_from_body.translation;
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
  const bool landing = phase_ == FlightPhase::kLanding;
  if (!landing && (holding_ || supervisor_.state == SafetyState::kHolding))
    follower_.stay();
  else
    follower_.step(dt, input.state.world_from_body.translation, landing);
  SetPoint target = follower_.setPoint();
  const Eigen::Vector3d pad(0.0, 0.0, pad_height_);
  const Eigen::Vector3d inside = pad + pushedBack(safety_options_, target.position_in_world - pad);
  if (inside.head<2>() != target.position_in_world.head<2>()) target.velocity_in_world.head<2>().setZero();
  target.position_in_world = inside;
  Controller::FlyOptions options;
  options.integrate_position = height > kIntegrateHeight;
  return controller_.fly(input.state, target, options, dt);
}

StickDemand Autopilot::flyBlind(const AutopilotInput& input) {
  // The model knows the next tenth of a second; feedback on a longer prediction is worse than none.
  Controller::FlyOptions options;
  options.integrate_position = false;
  if (supervisor_.state < SafetyState::kNeutral)
    options.feedback =
        std::min(0.999, std::exp(-(input.pose_age_s - safety_options_.coast_after_s) / kFadeTime));
  else
    options.feedback = 0.0;
  if (supervisor_.state == SafetyState::kDescending) {
    // Open loop: sink to the descent speed (or brake to it), hold it against the rotors' damping, and fade the
    // thrust once it should be down.
    const double since = toSeconds(input.now - supervisor_.descending_since);
    const double down = supervisor_.descent_s - kSettleOnSkids;
    const bool has_its_speed = since >= std::abs(supervisor_.sink_s);
    options.extra_thrust = has_its_speed ? kHoldSinkThrust : std::copysign(kSinkThrust, -supervisor_.sink_s);
    if (since > down) options.extra_thrust -= kFadeThrust * (since - down);
  }
  return controller_.fly(input.state, follower_.setPoint(), options, 1.0 / control_.rate_hz);
}

}  // namespace helical
