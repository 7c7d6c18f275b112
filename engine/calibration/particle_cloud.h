#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/base/random.h"
#include "engine/calibration/extrinsic_calibrator.h"

namespace helical {

/// Weighted mean and covariance of perturbations (order of CameraEstimate).
struct CloudMoments {
  Vector6d mean = Vector6d::Zero();
  Matrix6d covariance = Matrix6d::Zero();
};

/// Weighted camera poses, as perturbations of a reference that follows their mean. Allocates at construction
/// only. One thread.
class ParticleCloud {
 public:
  explicit ParticleCloud(int count);

  int count() const { return static_cast<int>(log_weights_.size()); }

  /// Draws all particles from a normal distribution; equal weights.
  void seed(const RigidTransform& mean, const Matrix6d& covariance, Random& random);

  /// Adds `exponent` times the log-likelihoods to the log-weights.
  void reweigh(std::span<const double> log_likelihoods, double exponent);
  /// The effective sample size that `reweigh` would leave.
  double effectiveSampleSizeAfter(std::span<const double> log_likelihoods, double exponent);
  double effectiveSampleSize() const { return effective_; }

  /// Systematic resampling, then the kernel of Liu and West (2001): particles shrink towards their mean by
  /// sqrt(1 - kernel^2) and get noise of `kernel` times their covariance, which keeps both moments.
  /// `kernel` = 0 leaves copies where they are.
  void resample(double kernel, Random& random);

  /// About `mean()`: the camera_from_world that the reference, perturbed by the mean, is.
  CloudMoments moments() const;
  RigidTransform mean() const;

  std::span<const WeightedPose> poses() const { return poses_; }

  /// Element `row` of the rotation matrix (row by row) and then of the translation of camera_from_world, of
  /// all particles one after another.
  std::span<const double> column(int row) const { return columns_[static_cast<std::size_t>(row)]; }

 private:
  void moveReference(const Vector6d& mean);
  void updatePoses();

  RigidTransform reference_;
  std::vector<Vector6d> changes_;
  std::vector<Vector6d> parents_changes_;
  std::vector<double> log_weights_;
  std::vector<double> trial_log_weights_;
  std::vector<double> weights_;
  std::vector<double> trial_weights_;
  std::vector<int> parents_;
  std::vector<WeightedPose> poses_;
  std::array<std::vector<double>, 12> columns_;
  double effective_ = 0.0;
};

}  // namespace helical
