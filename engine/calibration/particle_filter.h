#pragma once

#include <array>
#include <vector>

#include "engine/calibration/camera_perturbation.h"
#include "engine/calibration/particle_cloud.h"
#include "engine/calibration/particle_likelihood.h"
#include "engine/calibration/pose_modes.h"

namespace helical {

struct ParticleFilterOptions {
  int particles = 1000;
  double sigma_factor = 2.0;    ///< sigma of equation 11 over the centroid's own
  double floor = 1e-3;          ///< a of equation 11, per pixel
  double kernel = 0.5;          ///< h of Liu and West
  double resample_share = 0.5;  ///< resample below this effective share of particles
  double temper_share = 0.3;    ///< no reweighing leaves less than this effective share
  double literal_sigma_px =
      20.0;  ///< sigma of the literal kind: the paper gives none, a sharper one finds nobody
  double start_inflation = 3.0;  ///< first particles: standard deviations of the first resection, times this
};

/// Throws Error(kInput) naming the offending key.
void validate(const ParticleFilterOptions& options);

/// How the paper's filter (section III.C) is read.
enum class ParticleFilterKind {
  /// Likelihood per ball, resampling only when needed, the kernel of Liu and West in place of process noise
  /// (which a fixed camera has not), sharp likelihoods in steps (tempering), first particles around a
  /// resection of the first frames. One cloud is one mode: now and then the mirror image is compared with it
  /// over stored frames, and the cloud moves there as a whole when that fits clearly better.
  kStabilised,
  /// Equations 7, 8 and 11 as printed: no process noise for a camera, one Gaussian plus the floor per camera,
  /// first particles around the guess.
  kLiteral,
};

class ParticleFilter final : public ExtrinsicCalibrator {
 public:
  ParticleFilter(ParticleFilterKind kind, const ParticleFilterOptions& options, const GuessSpread& spread,
                 const CameraModel& camera, const MarkerLayout& markers, std::uint64_t seed);

  const char* name() const override {
    return kind_ == ParticleFilterKind::kLiteral ? "particle-filter-literal" : "particle-filter";
  }
  void restart(const RigidTransform& initial_guess) override;
  void correct(const CameraModel& camera, const MarkerLayout& markers) override {
    camera_ = camera;
    markers_ = markers;
    search_.correct(camera, markers);
  }
  void step(const CalibrationFrame& frame) override;
  CameraEstimate estimate() const override { return estimate_; }
  std::span<const WeightedPose> particles() const override;
  double effectiveSampleSize() const override { return started_ ? cloud_.effectiveSampleSize() : 0.0; }

 private:
  void considerModes();
  void seedAround(const MarginalResection& resection);
  Eigen::Matrix2d pixelCovariance(const CalibrationFrame& frame, const LabelledPixel& seen) const;
  std::span<const BearingTarget> targets(const CalibrationFrame& frame);
  double temperedExponent(double remaining);
  void filter(const CalibrationFrame& frame);

  ParticleFilterKind kind_;
  ParticleFilterOptions options_;
  GuessSpread spread_;
  CameraModel camera_;
  MarkerLayout markers_;
  std::uint64_t seed_;
  mutable ParticleCloud cloud_;  ///< writes its poses out on demand
  FrameStore store_;
  ModeSchedule schedule_;
  ModeSearch search_;
  bool search_due_ = false;
  std::vector<float> log_likelihoods_;
  std::array<BearingTarget, kMaxMarkers> targets_;
  bool started_ = false;
  RigidTransform guess_;
  CameraEstimate estimate_;
};

}  // namespace helical
