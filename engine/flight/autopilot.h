#pragma once

#include "engine/flight/controller.h"
#include "engine/flight/flight_plan.h"
#include "engine/flight/flight_state.h"
#include "engine/flight/operator_commands.h"
#include "engine/flight/plan_follower.h"
#include "engine/flight/supervisor.h"

namespace helical {

struct AutopilotInput {
  TimeNs now = 0;
  bool pose_known = false;  ///< a pose was found at least once
  double pose_age_s = 0.0;  ///< since the last observation that was used
  HelicopterState state;    ///< predicted to when the sticks will act
  OperatorCommands commands;
  SystemHealth health;
};

struct AutopilotOutput {
  StickDemand sticks;
  FlightPhase phase = FlightPhase::kIdle;
  SafetyState safety = SafetyState::kNormal;
  std::uint32_t failsafes = 0;  ///< that have ever acted
  std::uint32_t alarms = 0;     ///< failsafes and warnings that act now
  bool armed = false;
  std::uint32_t failing_checks = 0;  ///< bits of PreArmCheck, now
  std::uint32_t arm_refused = 0;  ///< at the tick of an order to arm that is refused: the checks that failed
  bool holding = false;           ///< by the operator's order
  SetPoint set_point;
  double pad_height = 0.0;  ///< of the body's origin standing on the pad, as seen before the start [m]
  bool hovering = false;    ///< has reached the first waypoint and is not landing
  bool airborne = false;
  const char* obstacle = nullptr;  ///< on the ground: why it could not start now; a literal
  const char* refusal = nullptr;   ///< at the tick when a take-off order is given up: why; a literal
};

/// The flight procedure: rotors up, lift-off, plan, landing, rotors off; the supervisor stands before the
/// controller (it changes what is flown) and after it (it cuts). Called once per control tick; one thread,
/// allocates nothing.
class Autopilot {
 public:
  Autopilot(const FlightPlan& plan, const ControllerOptions& control, const SupervisorOptions& safety,
            const HelicopterParameters& nominal);

  AutopilotOutput step(const AutopilotInput& input);

  /// The operator's changes between two steps: as PlanFollower::swapPlan has it, and gains and trims; rate
  /// and output delay stay.
  void swapPlan(FlightPlan& plan) { follower_.swapPlan(plan); }
  void setControl(const ControllerOptions& control);

 private:
  SupervisorConditions conditions(const AutopilotInput& input, double height) const;
  void obey(const OperatorCommands& commands);
  bool isBlocked(const AutopilotInput& input);
  void advance(const AutopilotInput& input, double height);
  StickDemand act(const AutopilotInput& input, double height);
  StickDemand flyBlind(const AutopilotInput& input);
  StickDemand flySighted(const AutopilotInput& input, double height);
  void enter(FlightPhase phase, TimeNs now);
  void awaitStart(const AutopilotInput& input);
  bool liftOffFails(const AutopilotInput& input) const;
  void smoothDrift(const AutopilotInput& input);
  bool hasTouchedDown(const AutopilotInput& input, double height);
  double flightTime(TimeNs now) const;

  ControllerOptions control_;
  SupervisorOptions safety_options_;
  Controller controller_;
  PlanFollower follower_;
  SupervisorMemory supervisor_;

  FlightPhase phase_ = FlightPhase::kIdle;
  TimeNs phase_since_ = 0;
  TimeNs started_ = 0;
  Eigen::Vector3d started_at_ = Eigen::Vector3d::Zero();
  double throttle_ = 0.0;   ///< in hover trims, while on the ground
  double standing_height_;  ///< nominal
  double pad_height_ = 0.0;
  bool was_blind_ = false;
  bool rotors_off_ = false;
  bool take_off_pending_ = false;
  bool holding_ = false;
  Eigen::Vector3d drift_ = Eigen::Vector3d::Zero();  ///< smoothed velocity [m/s]
  StickDemand sticks_;                               ///< of the last tick
  TimeNs few_since_ = -1;                            ///< fewer live cameras than it takes to arm
  TimeNs seen_since_ = -1;                           ///< on the ground, without a gap
  TimeNs still_since_ = -1;                          ///< while landing, with the reference at its lower end
  const char* refusal_ = nullptr;
};

}  // namespace helical
