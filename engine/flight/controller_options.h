#pragma once

#include <span>

namespace helical {

/// Gains of the four-channel controller. Swash plate in fractions of full stick, rotors in fractions 0..1.
/// Defaults were found by flying the simulated XRB with every parameter within +-30 % (tests/pipeline repeats
/// some).
struct ControllerOptions {
  double rate_hz = 60.0;
  double position_p = 1.8;            ///< per m
  double position_d = 2.1;            ///< per m/s
  double position_i = 0.5;            ///< per m s
  double position_i_limit = 0.35;     ///< fraction of full stick
  double position_error_limit = 0.5;  ///< m
  double tilt = 2.0;                  ///< per rad
  double phase = 0.20;                ///< rad: the swash plate's answer is rotated by about -11.5 degrees
  double height_p = 0.20;             ///< per m
  double height_d = 0.12;             ///< per m/s
  double height_i = 0.15;             ///< per m s
  double yaw_p = 1.5;                 ///< rad/s of wanted turn per rad
  double yaw_rate_limit = 0.8;        ///< rad/s, of the wanted turn
  double yaw_d = 0.006;               ///< per rad/s
  double yaw_i = 0.004;               ///< per rad: integrates the error of the turn
  double ground_yaw_d = 0.010;        ///< per rad/s: the same two on the skids, whose friction helps
  double ground_yaw_i = 0.02;         ///< per rad
  double output_delay_s = 0.023;      ///< from the control tick until the sticks act: transmitter and servo
  double trim_upper = 0.0;            ///< added to what the controller sends: rotor fraction
  double trim_lower = 0.0;            ///< rotor fraction
  double trim_roll = 0.0;             ///< fraction of full stick
  double trim_pitch = 0.0;            ///< fraction of full stick
};

/// One gain or trim that may be changed in flight, and how far that is safe: within it every flight of the
/// simulated XRB with parameters as drawn stays in the air, if not still.
struct ControllerKey {
  const char* name;
  double ControllerOptions::*value;
  double lowest;
  double highest;
  const char* unit;
};
/// In the order in which an operator thinks of them.
std::span<const ControllerKey> controllerKeys();

/// Throws Error(kInput) naming the offending key.
void validate(const ControllerOptions& options);

}  // namespace helical
