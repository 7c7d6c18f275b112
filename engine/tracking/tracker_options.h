#pragma once

namespace helical {

/// Tuning of the helicopter tracker (an extended Kalman filter on pixels). Noise densities are where the
/// adaptation starts.
struct TrackerOptions {
  double acceleration_noise_lateral = 0.15;   ///< m/s^2 per sqrt(Hz)
  double acceleration_noise_vertical = 0.18;  ///< m/s^2 per sqrt(Hz)
  double spin_noise_tilt = 2.4;               ///< rad/s^2 per sqrt(Hz)
  double spin_noise_yaw = 3.5;                ///< rad/s^2 per sqrt(Hz)
  double spin_decay_s = 0.3;                  ///< body rates decay in prediction
  double centroid_bias_px = 0.07;   ///< standard deviation of a centroid's offset that stays for many frames
  double gate_chi2 = 18.0;          ///< Mahalanobis gate of one centroid, 2 degrees of freedom
  double reacquire_after_s = 0.05;  ///< a longer gap ends in a new acquisition, never in one linear update
};

/// Throws Error(kInput) naming the offending key.
void validate(const TrackerOptions& options);

}  // namespace helical
