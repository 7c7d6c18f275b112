#pragma once

#include <vector>

#include "engine/calibration/camera_perturbation.h"
#include "engine/calibration/marginal_resection.h"
#include "engine/calibration/pose_modes.h"

namespace helical {

struct GrowingGaussNewtonOptions {
  int kept_frames = 300;       ///< bounds memory and time
  double robust_sigmas = 4.0;  ///< see MarginalResectionOptions
};

/// Throws Error(kInput) naming the offending key.
void validate(const GrowingGaussNewtonOptions& options);

/// Robust Gauss-Newton over all frames so far, thinned to `kept_frames` (see FrameStore). Solved again
/// whenever the kept frames have grown, or changed, by a sixteenth; now and then the mirror image of the
/// solution is tried. Both spread over several steps.
class GrowingGaussNewton final : public ExtrinsicCalibrator {
 public:
  GrowingGaussNewton(const GrowingGaussNewtonOptions& options, const GuessSpread& spread,
                     const CameraModel& camera, const MarkerLayout& markers);

  const char* name() const override { return "growing-gauss-newton"; }
  void restart(const RigidTransform& initial_guess) override;
  void correct(const CameraModel& camera, const MarkerLayout& markers) override {
    camera_ = camera;
    markers_ = markers;
    search_.correct(camera, markers);
  }
  void step(const CalibrationFrame& frame) override;
  CameraEstimate estimate() const override { return estimate_; }

 private:
  void checkModes(int& budget);
  void solve(int& budget);

  GrowingGaussNewtonOptions options_;
  GuessSpread spread_;
  CameraModel camera_;
  MarkerLayout markers_;
  FrameStore store_;
  ModeSchedule schedule_;
  ModeSearch search_;
  bool search_due_ = false;
  ResectionRun run_;
  std::vector<StoredFrame> solved_;  ///< what `run_` looks at, while the store goes on
  std::vector<const StoredFrame*> solved_order_;
  int unsolved_ = 0;
  RigidTransform guess_;
  CameraEstimate estimate_;
};

}  // namespace helical
