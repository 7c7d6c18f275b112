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
    case SafetyState::kHolding:
      return "holding";
    case SafetyState::kCoasting:
      return "coasting";
    case SafetyState::kNeutral:
      return "neutral";
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
    case Failsafe::kNoPoseNeutral:
      return "no-pose-neutral";
    case Failsafe::kFewCameras:
      return "no-camera-neutral";
    case Failsafe::kUncertain:
      return "uncertain-hold";
    case Failsafe::kUncertainLand:
      return "uncertain-land";
    case Failsafe::kSpeed:
      return "speed-land";
    case Failsafe::kTransmitterLost:
      return "transmitter-cut";
    case Failsafe::kFenceNear:
      return "fence-near";
    case Failsafe::kFlightTimeSoon:
      return "flight-time-soon";
    case Failsafe::kCameraSilent:
      return "camera-silent";
    case Failsafe::kCameraClock:
      return "camera-clock";
    case Failsafe::kOverrun:
      return "overrun";
    case Failsafe::kTransmitterFault:
      return "transmitter-fault";
    case Failsafe::kPilotFlies:
      return "pilot-flies";
    case Failsafe::kRecord:
      return "record";
    case Failsafe::kTransmitterStalled:
      return "transmitter-land";
    case Failsafe::kTransmitterSilent:
      return "transmitter-silent-cut";
  }
  return "?";
}

const char* messageOf(Failsafe failsafe) {
  switch (failsafe) {
    case Failsafe::kNoPoseCoast:
      return "No pose: coasting on trim";
    case Failsafe::kNoPoseDescent:
      return "No pose for 0.5 s: open-loop descent";
    case Failsafe::kNoPoseCut:
      return "The descent is over: rotors cut";
    case Failsafe::kTilt:
      return "Tilted too far: rotors cut";
    case Failsafe::kFence:
      return "Outside the fence: lands where it is";
    case Failsafe::kHardFence:
      return "Far outside the fence: rotors cut";
    case Failsafe::kFlightTime:
      return "The flight time is over: lands";
    case Failsafe::kKill:
      return "STOP: rotors cut, latched";
    case Failsafe::kLiftOffFailed:
      return "It does not lift off: rotors cut";
    case Failsafe::kNoPoseNeutral:
      return "No pose: neutral sticks";
    case Failsafe::kFewCameras:
      return "No calibrated camera is left: neutral sticks";
    case Failsafe::kUncertain:
      return "The pose is doubtful: holds";
    case Failsafe::kUncertainLand:
      return "The pose stays doubtful: lands";
    case Failsafe::kSpeed:
      return "Too fast: lands where it is";
    case Failsafe::kTransmitterLost:
      return "The transmitter is gone: output cut, fly by hand";
    case Failsafe::kFenceNear:
      return "Near the fence: pushed back";
    case Failsafe::kFlightTimeSoon:
      return "Nine tenths of the flight time are over";
    case Failsafe::kCameraSilent:
      return "A camera is silent";
    case Failsafe::kCameraClock:
      return "A camera's clock is off";
    case Failsafe::kOverrun:
      return "The flight thread is late";
    case Failsafe::kTransmitterFault:
      return "The transmitter does not take a demand";
    case Failsafe::kPilotFlies:
      return "The pilot's transmitter flies";
    case Failsafe::kRecord:
      return "The record of the flight has stopped";
    case Failsafe::kTransmitterStalled:
      return "The transmitter does not answer: lands as soon as it does, fly by hand";
    case Failsafe::kTransmitterSilent:
      return "The transmitter has not answered for long: output cut, fly by hand";
  }
  return "?";
}

const char* toString(PreArmCheck check) {
  switch (check) {
    case PreArmCheck::kCut:
      return "the rotors were cut; start Helical anew";
    case PreArmCheck::kFlightOver:
      return "the flight is over; start Helical anew for another one";
    case PreArmCheck::kPose:
      return "the helicopter is not seen";
    case PreArmCheck::kPad:
      return "it does not stand on the pad";
    case PreArmCheck::kUpright:
      return "it does not stand upright";
    case PreArmCheck::kStill:
      return "it moves";
    case PreArmCheck::kFence:
      return "it is outside the fence";
    case PreArmCheck::kCameras:
      return "too few calibrated cameras give frames";
    case PreArmCheck::kFrameRate:
      return "a camera loses frames";
    case PreArmCheck::kResidual:
      return "the cameras disagree about the pose";
    case PreArmCheck::kCovariance:
      return "the pose is too uncertain";
    case PreArmCheck::kYaw:
      return "the nose does not point along the pad: which way it stands is ambiguous";
    case PreArmCheck::kTransmitter:
      return "the transmitter is not ready";
    case PreArmCheck::kChannels:
      return "the channels of the transmitter are not calibrated, or nobody has looked which way they go";
    case PreArmCheck::kPilot:
      return "the pilot's transmitter flies";
    case PreArmCheck::kSticks:
      return "the sticks are not at zero";
    case PreArmCheck::kRecord:
      return "the record of the flight has stopped";
    case PreArmCheck::kDisk:
      return "the disk for the record is almost full";
    case PreArmCheck::kCpu:
      return "the machine is too busy for the control rate";
  }
  return "?";
}

}  // namespace helical
