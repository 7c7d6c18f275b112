#include "engine/flight/flight_state.h"

namespace helical {

const char* toString(FlightPhase phase) {
  switch (phase) {
    case FlightPhase::kIdle:
      return "idle";
    case FlightPhase::kSpinUp:
      return "spin-up";
    case FlightPhase::kLiftOff:
      return "lift-off";
    case FlightPhase::kFlying:
      return "flying";
    case FlightPhase::kLanding:
      return "landing";
    case FlightPhase::kTouchdown:
      return "touchdown";
    case FlightPhase::kOff:
      return "off";
  }
  return "?";
}

const char* toString(SafetyState state) {
  switch (state) {
    case SafetyState::kNormal:
      return "normal";
    case SafetyState::kCoasting:
      return "coasting";
    case SafetyState::kDescending:
      return "descending";
    case SafetyState::kLandNow:
      return "land-now";
    case SafetyState::kCut:
      return "cut";
  }
  return "?";
}

const char* toString(Failsafe failsafe) {
  switch (failsafe) {
    case Failsafe::kNoPoseCoast:
      return "no-pose-coast";
    case Failsafe::kNoPoseDescent:
      return "no-pose-descent";
    case Failsafe::kNoPoseCut:
      return "no-pose-cut";
    case Failsafe::kTilt:
      return "tilt-cut";
    case Failsafe::kFence:
      return "fence-land";
    case Failsafe::kHardFence:
      return "fence-cut";
    case Failsafe::kFlightTime:
      return "flight-time-land";
    case Failsafe::kKill:
      return "kill";
    case Failsafe::kLiftOffFailed:
      return "lift-off-failed";
  }
  return "?";
}

}  // namespace helical
