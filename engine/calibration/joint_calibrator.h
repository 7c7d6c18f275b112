#pragma once

#include <vector>

#include "engine/calibration/camera_perturbation.h"
#include "engine/calibration/joint_search.h"
#include "engine/calibration/joint_smoother.h"

namespace helical {

struct JointOptions {
  JointSearchOptions search;
  JointSmootherOptions smoother;
  int frame_units = 32;  ///< work in a camera frame beyond its own: frames looked at once more
};

/// Throws Error(kInput) naming the offending key.
void validate(const JointOptions& options);

/// Where a camera is, from centroids without names and without a guess: first JointSearch finds names and
/// pose, then JointSmoother takes in every frame since the start, with the helicopter's pose in each frame
/// marginalised. Reaches the Cramer-Rao bound; its covariance is that of its errors. When most centroids
/// have long been somewhere else than it says (the camera was moved, or the names were wrong), it forgets all
/// and searches again. The work for one frame is bounded in units of work, not in time, so that it repeats
/// bit for bit.
class JointCalibrator final : public ExtrinsicCalibrator {
 public:
  JointCalibrator(const JointOptions& options, const GuessSpread& spread, const CameraModel& camera,
                  const MarkerLayout& markers);

  const char* name() const override { return "joint"; }
  void restart(const RigidTransform& initial_guess) override;
  void step(const CalibrationFrame& frame) override;
  CameraEstimate estimate() const override { return estimate_; }
  bool namesCentroids() const override { return true; }
  std::span<const LabelledPixel> named() const override;

 private:
  void forget();
  void remember(const CalibrationFrame& frame);
  void seek();
  void learn();
  bool lost(const UnnamedFrame& frame);

  JointOptions options_;
  GuessSpread spread_;
  MarkerLayout markers_;
  CameraModel camera_;
  JointSearch search_;
  JointSmoother smoother_;
  std::vector<UnnamedFrame> recent_;  ///< frames that the smoother has not seen: a ring
  int first_ = 0, recent_count_ = 0;
  bool locked_ = false;
  bool current_named_ = false;
  double fitting_ = 1.0;  ///< running share of the balls that were found where they should be
  StoredFrame named_;     ///< the newest that the smoother took in
  RigidTransform guess_;
  CameraEstimate estimate_;
};

}  // namespace helical
