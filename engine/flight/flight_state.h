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

/// What the supervisor allows, from mild to severe: of several demands the most severe counts. Coasting,
/// neutral, descending and holding end with their cause, an order to land stays, a cut is latched.
enum class SafetyState : std::uint8_t {
  kNormal,
  kHolding,     ///< the pose is doubtful: stays where it is
  kLandNow,     ///< fence, speed, flight time: lands where it is
  kCoasting,    ///< no pose for a moment: feedback fades to trim
  kNeutral,     ///< no pose for longer: trims alone
  kDescending,  ///< no pose for long: open-loop descent
  kCut,         ///< rotors off, latched
};

/// What the supervisor watches, as bits. Those that demand more than kNormal are failsafes (names as in `fly
/// --json`), the others warnings.
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
  kNoPoseNeutral = 1u << 9,
  kFewCameras = 1u << 10,
  kUncertain = 1u << 11,
  kUncertainLand = 1u << 12,
  kSpeed = 1u << 13,
  kTransmitterLost = 1u << 14,   ///< it is gone, and with it what it was told
  kFenceNear = 1u << 15,
  kFlightTimeSoon = 1u << 16,
  kCameraSilent = 1u << 17,
  kCameraClock = 1u << 18,
  kOverrun = 1u << 19,
  kTransmitterFault = 1u << 20,
  kPilotFlies = 1u << 21,
  kRecord = 1u << 22,
  kTransmitterStalled = 1u << 23,  ///< it is there, and has taken nothing for a while
  kTransmitterSilent = 1u << 24,   ///< for long
};
inline constexpr int kFailsafeCount = 25;

constexpr std::uint32_t bitOf(Failsafe failsafe) {
  return static_cast<std::uint32_t>(failsafe);
}

/// What must be so before the rotors are allowed to turn, as bits of what is not.
enum class PreArmCheck : std::uint32_t {
  kCut = 1u << 0,
  kFlightOver = 1u << 1,
  kPose = 1u << 2,
  kPad = 1u << 3,
  kUpright = 1u << 4,
  kStill = 1u << 5,
  kFence = 1u << 6,
  kCameras = 1u << 7,
  kFrameRate = 1u << 8,
  kResidual = 1u << 9,
  kCovariance = 1u << 10,
  kYaw = 1u << 11,
  kTransmitter = 1u << 12,
  kChannels = 1u << 13,
  kPilot = 1u << 14,
  kSticks = 1u << 15,
  kRecord = 1u << 16,
  kDisk = 1u << 17,
  kCpu = 1u << 18,
};
inline constexpr int kPreArmCheckCount = 19;

constexpr std::uint32_t bitOf(PreArmCheck check) {
  return static_cast<std::uint32_t>(check);
}

const char* toString(FlightPhase phase);
const char* toString(SafetyState state);
const char* toString(Failsafe failsafe);
/// Why it does not arm, for the operator.
const char* toString(PreArmCheck check);
/// What happens because of it, for the operator.
const char* messageOf(Failsafe failsafe);

/// Where the helicopter should be now.
struct SetPoint {
  Eigen::Vector3d position_in_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_in_world = Eigen::Vector3d::Zero();
  double yaw = 0.0;
};

}  // namespace helical
