#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "engine/base/time.h"
#include "engine/helicopter/helicopter_state.h"

namespace helical {

/// Where the flight procedure is.
enum class FlightPhase : std::uint8_t {
  kIdle,       ///< rotors off, waiting for the start
  kSpinUp,     ///< rotors up to 75 % of hover trim, on the skids
  kLiftOff,    ///< throttle ramps until it is airborne; yaw trim learnt on the way
  kFlying,     ///< follows the plan
  kLanding,    ///< descends to the pad
  kTouchdown,  ///< on the ground, throttle ramps down
  kOff,        ///< done: rotors off
};

constexpr bool rotorsTurn(FlightPhase phase) {
  return phase != FlightPhase::kIdle && phase != FlightPhase::kOff;
}
constexpr bool inTheAir(FlightPhase phase) {
  return phase == FlightPhase::kFlying || phase == FlightPhase::kLanding;
}

/// What the supervisor allows. Only ever worsens by itself, but for kCoasting and kDescending, which end when
/// the pose is back; kCut is latched.
enum class SafetyState : std::uint8_t {
  kNormal,
  kCoasting,    ///< no pose for a moment: feedback fades to trim
  kDescending,  ///< no pose for long: open-loop descent
  kLandNow,     ///< fence or flight time: land where it is
  kCut,         ///< rotors off, latched
};

/// Failsafes that acted, as bits; names as in `fly --json`.
enum class Failsafe : std::uint32_t {
  kNoPoseCoast = 1u << 0,
  kNoPoseDescent = 1u << 1,
  kNoPoseCut = 1u << 2,
  kTilt = 1u << 3,
  kFence = 1u << 4,
  kHardFence = 1u << 5,
  kFlightTime = 1u << 6,
  kKill = 1u << 7,
  kLiftOffFailed = 1u << 8,
};

const char* toString(FlightPhase phase);
const char* toString(SafetyState state);
const char* toString(Failsafe failsafe);

/// Where the helicopter should be now.
struct SetPoint {
  Eigen::Vector3d position_in_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_in_world = Eigen::Vector3d::Zero();
  double yaw = 0.0;
};

}  // namespace helical
