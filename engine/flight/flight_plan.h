#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace helical {

/// A place to be for a while. Position is of the body's origin relative to where it stood on the pad, in the
/// world's axes: (0, 0, 0.6) hovers 60 cm above the pad.
struct Waypoint {
  Eigen::Vector3d position_above_pad = Eigen::Vector3d::Zero();  ///< m
  double yaw = 0.0;                                              ///< rad
  double hold_s = 0.0;  ///< time to stay after the reference got there
  double speed = 0.25;  ///< m/s on the way there
};

/// What a flight is to do. Times count from the start of the plan (rotors off, pose known).
struct FlightPlan {
  std::string name = "hover";
  double carried_s = 0.0;         ///< in simulation somebody waves it through the space for so long before it flies
  double start_delay_s = 0.5;     ///< after the pose is first known, before the rotors start
  double climb_speed = 0.25;      ///< m/s
  double descent_speed = 0.18;    ///< m/s
  double touchdown_speed = 0.10;  ///< m/s, below 0.12 m
  std::vector<Waypoint> waypoints{
      {{0.0, 0.0, 0.6}, 0.0, 0.0, 0.25}};  ///< at least one; the first is the take-off height
  double land_at_s = 19.0;  ///< landing begins at this flight time [s]; <= 0: after the last waypoint's hold
};

/// Throws Error(kInput) naming the offending value.
void validate(const FlightPlan& plan);

}  // namespace helical
