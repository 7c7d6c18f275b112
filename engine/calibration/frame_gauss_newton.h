#pragma once

#include "engine/calibration/camera_perturbation.h"
#include "engine/calibration/marginal_resection.h"

namespace helical {

struct FrameGaussNewtonOptions {
  bool warm_start = false;  ///< from the last frame's result instead of the guess; diverges sooner or later
  int iterations = 20;
};

/// Throws Error(kInput) naming the offending key.
void validate(const FrameGaussNewtonOptions& options);

/// Experiment A of the paper: bundle adjustment by plain Gauss-Newton in each frame on its own. A frame whose
/// solution diverges leaves the estimate as it was.
class FrameGaussNewton final : public ExtrinsicCalibrator {
 public:
  FrameGaussNewton(const FrameGaussNewtonOptions& options, const GuessSpread& spread,
                   const CameraModel& camera, const MarkerLayout& markers);

  const char* name() const override { return "gauss-newton"; }
  void restart(const RigidTransform& initial_guess) override;
  void correct(const CameraModel& camera, const MarkerLayout& markers) override {
    camera_ = camera;
    markers_ = markers;
  }
  void step(const CalibrationFrame& frame) override;
  CameraEstimate estimate() const override { return estimate_; }

 private:
  FrameGaussNewtonOptions options_;
  GuessSpread spread_;
  CameraModel camera_;
  MarkerLayout markers_;
  RigidTransform guess_;
  CameraEstimate estimate_;
};

}  // namespace helical
