#pragma once

#include <Eigen/Core>

#include "engine/helicopter/helicopter_state.h"

namespace helical {

using Matrix12d = Eigen::Matrix<double, 12, 12>;

/// Order of the error state: position in world, velocity in world, rotation vector on the right of
/// world_from_body, angular velocity in body.
enum ErrorState { kPositionError = 0, kVelocityError = 3, kRotationError = 6, kSpinError = 9 };

/// Densities of the white accelerations by which the motion model may be wrong.
struct MotionNoise {
  double lateral = 0.0;   ///< m/s^2 per sqrt(Hz)
  double vertical = 0.0;  ///< m/s^2 per sqrt(Hz)
  double tilt = 0.0;      ///< rad/s^2 per sqrt(Hz), about the body's x and y
  double yaw = 0.0;       ///< rad/s^2 per sqrt(Hz)
};

/// How the tracker believes that the helicopter moves: constant velocity and decaying body rates on the
/// ground; in the air the thrust follows the shaft, so that a tilt accelerates it sideways by g times the
/// shaft's horizontal part. What this leaves out (gusts, flapping, thrust changes, torques) is white
/// acceleration noise.
class MotionModel {
 public:
  /// `spin_decay_s`: time in which body rates decay in prediction.
  explicit MotionModel(double spin_decay_s) : spin_decay_s_(spin_decay_s) {}

  /// Moves `state` by `dt` seconds, either way.
  void propagate(HelicopterState& state, double dt, bool airborne) const;
  /// The same with the covariance of its error; noise is added forwards only.
  void propagate(HelicopterState& state, Matrix12d& covariance, const MotionNoise& noise, double dt,
                 bool airborne) const;

 private:
  void step(HelicopterState& state, double dt, bool airborne) const;
  Matrix12d transition(const HelicopterState& state, double dt, bool airborne) const;

  double spin_decay_s_;
};

}  // namespace helical
