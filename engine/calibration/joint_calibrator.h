#pragma once

#include <vector>

#include "engine/calibration/camera_perturbation.h"
#include "engine/calibration/joint_search.h"
#include "engine/calibration/joint_smoother.h"

namespace helical {

/// Errors of centroids that stay for many frames: averaging over frames does not lower them as it lowers
/// noise. As an offset per axis whose correlation decays exponentially.
struct LastingOffsets {
  double sigma_px = 0.08;
  double time_s = 1.0;
};

struct JointOptions {
  JointSearchOptions search;
  JointSmootherOptions smoother;
  LastingOffsets lasting;
  int frame_units = 32;  ///< work in a camera frame beyond its own: frames looked at once more
};

/// Throws Error(kInput) naming the offending key.
void validate(const JointOptions& options);

/// Where a camera is, from centroids without names and without a guess: first JointSearch finds names and
/// pose, then JointSmoother takes in every frame since the start, with the helicopter's pose in each frame
/// marginalised. Reaches the Cramer-Rao bound; its covariance is that of its errors, lasting offsets of the
/// centroids in this and the other cameras included. When most centroids
/// have long been somewhere else than it says (the camera was moved, or the names were wrong), it forgets all
/// and searches again. The work for one frame is bounded in units of work, not in time, so that it repeats
/// bit for bit.
class JointCalibrator final : public ExtrinsicCalibrator {
 public:
  JointCalibrator(const JointOptions& options, const GuessSpread& spread, const CameraModel& camera,
                  const MarkerLayout& markers);

  const char* name() const override { return "joint"; }
  void restart(const RigidTransform& initial_guess) override;
  void correct(const CameraModel& camera, const MarkerLayout& markers) override {
    camera_ = camera;
    markers_ = markers;
    search_.correct(camera, markers);
    smoother_.correct(camera, markers);
  }
  void step(const CalibrationFrame& frame) override;
  bool goOnFrom(const CameraEstimate& estimate) override;
  CameraEstimate estimate() const override { return estimate_; }
  bool namesCentroids() const override { return true; }
  bool knowsItsPlace() const override { return locked_; }
  std::span<const LabelledPixel> named() const override;
  TriedLabellings labellings() const override { return labellings_; }
  bool coversLastingOffsets() const override { return true; }

 private:
  void forget();
  void remember(const CalibrationFrame& frame);
  void seek();
  void noteLabellings(const UnnamedFrame& frame);
  void learn();
  bool lost(const UnnamedFrame& frame);
  void countNoise(const UnnamedFrame& frame);
  double noiseInflation() const;

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
  TimeNs learnt_from_ = 0, learnt_to_ = 0;
  double learnt_frames_ = 0.0, learnt_variance_ = 0.0;  ///< of centroids, summed over the frames [px^2]
  Matrix6d known_ = Matrix6d::Zero();  ///< information that it went on from
  double known_weight_ = 1.0;          ///< with which the smoother has that
  double fitting_ = 1.0;  ///< running share of the balls that were found where they should be
  StoredFrame named_;     ///< the newest that the smoother took in
  TriedLabellings labellings_;
  RigidTransform guess_;
  CameraEstimate estimate_;
};

}  // namespace helical
