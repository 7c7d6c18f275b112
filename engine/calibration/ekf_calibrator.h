#pragma once

#include "engine/calibration/camera_perturbation.h"
#include "engine/calibration/frame_information.h"

namespace helical {

struct EkfOptions {
  int iterations = 4;          ///< linearisations in one frame
  double robust_sigmas = 4.0;  ///< see RobustWeights
};

/// Throws Error(kInput) naming the offending key.
void validate(const EkfOptions& options);

/// Iterated extended Kalman filter in information form, with names given: each frame is linearised anew until
/// its estimate rests, then added for good, with the helicopter's pose marginalised. While the fit is poor
/// the robust scale follows the median residual and the frame counts for that much less. One mode: from a
/// guess on the wrong side it does not come back.
class EkfCalibrator final : public ExtrinsicCalibrator {
 public:
  EkfCalibrator(const EkfOptions& options, const GuessSpread& spread, const CameraModel& camera,
                const MarkerLayout& markers);

  const char* name() const override { return "ekf"; }
  void restart(const RigidTransform& initial_guess) override;
  void correct(const CameraModel& camera, const MarkerLayout& markers) override {
    camera_ = camera;
    markers_ = markers;
  }
  void step(const CalibrationFrame& frame) override;
  CameraEstimate estimate() const override { return estimate_; }

 private:
  EkfOptions options_;
  GuessSpread spread_;
  CameraModel camera_;
  MarkerLayout markers_;
  Matrix6d information_ = Matrix6d::Zero();
  CameraEstimate estimate_;
};

}  // namespace helical
