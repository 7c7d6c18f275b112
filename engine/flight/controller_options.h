#pragma once

namespace helical {

/// Gains of the four-channel controller. Swash plate in fractions of full stick, rotors in fractions 0..1.
/// Defaults: gains found in a closed-loop study of the model at 40 ms of delay; they hold for +-30 % of every
/// parameter and up to 60 ms.
struct ControllerOptions {
  double rate_hz = 60.0;
  double position_p = 1.2;            ///< per m
  double position_d = 1.4;            ///< per m/s
  double position_i = 0.4;            ///< per m s
  double position_i_limit = 0.35;     ///< fraction of full stick
  double position_error_limit = 0.5;  ///< m
  double tilt = 2.0;                  ///< per rad
  double phase = 0.20;                ///< rad: the swash plate's answer is rotated by about -11.5 degrees
  double height_p = 0.20;             ///< per m
  double height_d = 0.12;             ///< per m/s
  double height_i = 0.15;             ///< per m s
  double yaw_p = 0.008;               ///< per rad
  double yaw_d = 0.0045;              ///< per rad/s
  double yaw_i = 0.006;               ///< per rad s
  double spin_i = 0.006;              ///< per rad: integrates the yaw rate while it spins or stands
  double output_delay_s = 0.023;      ///< from the control tick until the sticks act: transmitter and servo
};

/// Throws Error(kInput) naming the offending key.
void validate(const ControllerOptions& options);

}  // namespace helical
