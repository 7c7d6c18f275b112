#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/base/random.h"
#include "engine/calibration/extrinsic_calibrator.h"
#include "engine/calibration/normal_deviates.h"

namespace helical {

/// Particles that a loop takes at a time, so that what it needs stays in the nearest cache.
inline constexpr std::size_t kParticleBlock = 256;

/// Weighted mean and covariance of perturbations (order of CameraEstimate).
struct CloudMoments {
  Vector6d mean = Vector6d::Zero();
  Matrix6d covariance = Matrix6d::Zero();
};

/// Weighted camera poses, as perturbations of a reference that follows their mean. Their rotations are kept
/// as modified Rodrigues parameters, four times the tangent of a quarter of the angle: rotation vectors to
/// third order, and no sine in the loops over particles, which run on arrays in single precision. Allocates
/// at construction only. One thread.
class ParticleCloud {
 public:
  ParticleCloud(int count, std::uint64_t random_seed);

  int count() const { return static_cast<int>(log_weights_.size()); }

  /// As after construction.
  void restart(std::uint64_t random_seed);

  /// Draws all particles from a normal distribution; equal weights.
  void seed(const RigidTransform& mean, const Matrix6d& covariance);

  /// Adds `exponent` times the log-likelihoods to the log-weights.
  void reweigh(std::span<const float> log_likelihoods, double exponent);
  /// The effective sample size that `reweigh` would leave.
  double effectiveSampleSizeAfter(std::span<const float> log_likelihoods, double exponent);
  double effectiveSampleSize() const { return effective_; }

  /// Systematic resampling, then the kernel of Liu and West (2001): particles shrink towards their mean by
  /// sqrt(1 - kernel^2) and get noise of `kernel` times their covariance, which keeps both moments.
  /// `kernel` = 0 leaves copies where they are.
  void resample(double kernel);

  /// About `pose(moments().mean)`.
  CloudMoments moments() const;
  /// The reference, perturbed: camera_from_world.
  RigidTransform pose(const Vector6d& perturbation) const;

  /// All particles, by index; written anew by every call.
  std::span<const WeightedPose> poses();

  /// Element `row` of the rotation matrix (row by row) and then of the translation of camera_from_world, of
  /// all particles one after another, filled up with zeros to whole blocks.
  std::span<const float> column(int row) const { return columns_[static_cast<std::size_t>(row)]; }

 private:
  using Column = std::vector<float>;

  /// changes = offset + scale * changes + root * noise.
  void disperse(const Vector6d& offset, double scale, const Matrix6d& root);
  void startEqual();
  void moveReference(const Vector6d& mean);
  void updateColumns();

  RigidTransform reference_;
  Random random_;
  NormalDeviates deviates_;
  std::array<Column, 6> changes_;
  std::array<Column, 6> spare_;  ///< parents' changes, or noise
  std::array<Column, 12> columns_;
  Column log_weights_;
  Column trial_log_weights_;
  Column weights_;
  Column trial_weights_;
  std::vector<int> parents_;
  std::vector<WeightedPose> poses_;
  float trial_largest_ = 0.0F;
  double effective_ = 0.0;
};

}  // namespace helical
