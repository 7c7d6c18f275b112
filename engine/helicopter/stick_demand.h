#pragma once

namespace helical {

/// What the transmitter is asked for: the four channels of a coaxial helicopter, dimensionless. The two rotor
/// channels together are throttle, their difference is yaw.
struct StickDemand {
  double upper_rotor = 0.0;  ///< 0 off .. 1 full
  double lower_rotor = 0.0;  ///< 0 off .. 1 full
  double roll = 0.0;         ///< swash plate, -1 .. 1; positive tips the thrust to the body's -y
  double pitch = 0.0;        ///< swash plate, -1 .. 1; positive tips the thrust to the body's +x

  bool operator==(const StickDemand&) const = default;
};

}  // namespace helical
