#pragma once

namespace helical {

/// Thresholds of the supervisor; they stand beside those of trusted systems in engine/flight/README.md.
struct SupervisorOptions {
  double coast_after_s = 0.05;     ///< without a pose: controller fades to trim
  double descend_after_s = 0.5;    ///< without a pose: open-loop descent
  double descent_speed = 0.5;      ///< m/s, of the open-loop descent
  double longest_descent_s = 6.0;  ///< then the rotors are cut, whatever the height
  double tilt_limit = 1.047;       ///< rad (60 degrees)
  double tilt_time_s = 0.3;
  double fence_radius = 1.5;           ///< m from the pad's centre; beyond: land
  double fence_height = 2.0;           ///< m
  double hard_fence_margin = 0.5;      ///< m beyond the fence: cut
  double flight_time_limit_s = 600.0;  ///< then it lands
};

/// Throws Error(kInput) naming the offending key.
void validate(const SupervisorOptions& options);

}  // namespace helical
