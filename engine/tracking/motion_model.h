#pragma once

#include <Eigen/Core>

#include "engine/helicopter/helicopter_state.h"
#include "engine/tracking/tracker_options.h"

namespace helical {

using Matrix12d = Eigen::Matrix<double, 12, 12>;

/// Order of the error state: position in world, velocity in world, rotation vector on the right of
/// world_from_body, angular velocity in body.
enum ErrorState { kPositionError = 0, kVelocityError = 3, kRotationError = 6, kSpinError = 9 };

/// How the tracker believes that the helicopter moves: constant velocity and decaying body rates on the
/// ground; in the air the thrust follows the shaft, so that a tilt accelerates it sideways by g times the
/// shaft's horizontal part. What this leaves out (gusts, flapping, thrust changes) is white acceleration
/// noise.
class MotionModel {
 public:
  explicit MotionModel(const TrackerOptions& options) : options_(options) {}

  /// Moves `state`, and `covariance` unless null, by `dt` seconds (either sign; noise is added forwards
  /// only).
  void propagate(HelicopterState& state, Matrix12d* covariance, double dt, bool airborne) const;

 private:
  void step(HelicopterState& state, Matrix12d* covariance, double dt, bool airborne) const;

  TrackerOptions options_;
};

}  // namespace helical
