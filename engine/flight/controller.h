#pragma once

#include <Eigen/Core>

#include "engine/flight/controller_options.h"
#include "engine/flight/flight_state.h"
#include "engine/helicopter/helicopter_parameters.h"
#include "engine/helicopter/stick_demand.h"

namespace helical {

/// Four-channel controller of the coaxial helicopter, ours (the paper's own control law is not public): x and
/// y by proportional, integral, velocity and tilt feedback on the swash plate, turned by the rotor's phase
/// angle; height and yaw on sum and difference of the rotors, mixed so that thrust does not turn it and yaw
/// does not lift it, with a lead that makes the slow upper motor answer like the lower. Knows the nominal
/// helicopter only. One thread.
class Controller {
 public:
  Controller(const ControllerOptions& options, const HelicopterParameters& nominal);

  /// Forgets what it has integrated.
  void reset();

  /// Other gains and trims from now on; what it has integrated stays.
  void setOptions(const ControllerOptions& options) { options_ = options; }

  /// Throttle of both rotors as a fraction of hover trim, while it stands on the skids; keeps the heading's
  /// rate at zero and learns the yaw trim on the way. Swash plate: damping only.
  StickDemand onGround(const HelicopterState& state, double throttle, double dt);

  /// Freezes the throttle at which it left the ground as base of the height loop. `climb` [m/s] is how fast it rises by
  /// then, `ramp` how fast the throttle was opened [hover trims per second].
  void liftOff(double throttle, double climb = 0.0, double ramp = 0.0);

  struct FlyOptions {
    bool integrate_position = true;  ///< off near the ground
    /// 1: full; fades to 0 without a pose, when trims alone remain, and the thrust that carried it when it was seen.
    double feedback = 1.0;
    double extra_thrust = 0.0;       ///< rotor fraction added to the base, of an open-loop descent
  };
  /// Flies to the set-point.
  StickDemand fly(const HelicopterState& state, const SetPoint& set_point, const FlyOptions& options,
                  double dt);

  /// On the ground after landing: rotors from where they are to zero at `rate` per second. True once they are
  /// off.
  bool spinDown(double rate, double dt, StickDemand& demand);

 private:
  void learnHoverThrust(double climb, double dt);
  StickDemand mix(double thrust, double yaw, const Eigen::Vector2d& swash_in_body, bool lead, double dt);

  ControllerOptions options_;
  double trim_upper_, trim_lower_;      // hover sticks
  double thrust_upper_, thrust_lower_;  // of a unit of thrust, torque-free
  double yaw_upper_, yaw_lower_;        // of a unit of yaw, thrust-free
  double upper_time_, lower_time_;      // motors [s]
  double base_ = 0.0;                   // throttle, in hover trims
  double thrust_ = 0.0;                 // last thrust correction
  double height_integral_ = 0.0;
  double hover_thrust_ = 0.0;  // correction that would keep it from accelerating, as seen
  double thrust_of_motors_ = 0.0, climb_expected_ = 0.0;  // of the observer behind it
  double yaw_integral_ = 0.0;
  Eigen::Vector2d position_integral_ = Eigen::Vector2d::Zero();  // body heading frame
  double lag_ = 0.0;                                             // of the upper motor's lead
  bool lag_known_ = false;
};

}  // namespace helical
