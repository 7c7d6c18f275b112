#include "engine/calibration/particle_cloud.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "engine/base/check.h"
#include "engine/calibration/camera_perturbation.h"
#include "engine/calibration/resampling.h"
#include "engine/geometry/camera_perturbation.h"
#include "engine/geometry/rotation.h"

namespace helical {
namespace {

constexpr double kReferenceDriftRad = 0.02;  // beyond, averages of rotation vectors lose accuracy

/// Square root of a covariance that may be singular up to rounding.
Matrix6d squareRoot(const Matrix6d& covariance) {
  Matrix6d regular = covariance;
  regular.diagonal().array() += 1e-18;
  return regular.llt().matrixL();
}

Vector6d standardNormal(Random& random) {
  Vector6d v;
  for (double& x : v) x = random.normal();
  return v;
}

}  // namespace

ParticleCloud::ParticleCloud(int count) {
  HELICAL_CHECK(count >= 2);
  const auto size = static_cast<std::size_t>(count);
  changes_.resize(size, Vector6d::Zero());
  parents_changes_.resize(size);
  log_weights_.resize(size);
  trial_log_weights_.resize(size);
  weights_.resize(size, 1.0 / count);
  trial_weights_.resize(size);
  parents_.resize(size);
  poses_.resize(size);
  for (auto& column : columns_) column.resize(size);
}

void ParticleCloud::seed(const RigidTransform& mean, const Matrix6d& covariance, Random& random) {
  reference_ = mean;
  const Matrix6d root = squareRoot(covariance);
  for (Vector6d& change : changes_) change = root * standardNormal(random);
  std::fill(log_weights_.begin(), log_weights_.end(), 0.0);
  std::fill(weights_.begin(), weights_.end(), 1.0 / count());
  effective_ = count();
  updatePoses();
}

void ParticleCloud::reweigh(std::span<const double> log_likelihoods, double exponent) {
  for (std::size_t i = 0; i < log_weights_.size(); ++i) log_weights_[i] += exponent * log_likelihoods[i];
  normaliseLogWeights(log_weights_, weights_);
  effective_ = helical::effectiveSampleSize(weights_);
  for (std::size_t i = 0; i < poses_.size(); ++i) poses_[i].weight = weights_[i];
}

double ParticleCloud::effectiveSampleSizeAfter(std::span<const double> log_likelihoods, double exponent) {
  for (std::size_t i = 0; i < log_weights_.size(); ++i)
    trial_log_weights_[i] = log_weights_[i] + exponent * log_likelihoods[i];
  normaliseLogWeights(trial_log_weights_, trial_weights_);
  return helical::effectiveSampleSize(trial_weights_);
}

CloudMoments ParticleCloud::moments() const {
  CloudMoments moments;
  for (std::size_t i = 0; i < changes_.size(); ++i) moments.mean += weights_[i] * changes_[i];
  for (std::size_t i = 0; i < changes_.size(); ++i) {
    const Vector6d deviation = changes_[i] - moments.mean;
    moments.covariance.noalias() += (weights_[i] * deviation) * deviation.transpose();
  }
  return moments;
}

RigidTransform ParticleCloud::mean() const {
  Vector6d mean = Vector6d::Zero();
  for (std::size_t i = 0; i < changes_.size(); ++i) mean += weights_[i] * changes_[i];
  return perturbCamera(reference_, mean);
}

void ParticleCloud::resample(double kernel, Random& random) {
  const CloudMoments before = moments();
  systematicResample(weights_, random.uniform(), parents_);
  for (std::size_t i = 0; i < changes_.size(); ++i)
    parents_changes_[i] = changes_[static_cast<std::size_t>(parents_[i])];
  changes_.swap(parents_changes_);
  if (kernel > 0.0) {
    const double shrink = std::sqrt(1.0 - kernel * kernel);
    const Matrix6d noise = kernel * squareRoot(before.covariance);
    for (Vector6d& change : changes_)
      change = before.mean + shrink * (change - before.mean) + noise * standardNormal(random);
  }
  std::fill(log_weights_.begin(), log_weights_.end(), 0.0);
  std::fill(weights_.begin(), weights_.end(), 1.0 / count());
  effective_ = count();
  if (before.mean.head<3>().norm() > kReferenceDriftRad) moveReference(before.mean);
  updatePoses();
}

void ParticleCloud::moveReference(const Vector6d& mean) {
  const Eigen::Quaterniond back = expSO3(mean.head<3>()).conjugate();
  for (Vector6d& change : changes_) {
    change.head<3>() = logSO3(expSO3(change.head<3>()) * back);
    change.tail<3>() -= mean.tail<3>();
  }
  reference_ = perturbCamera(reference_, mean);
}

void ParticleCloud::updatePoses() {
  for (std::size_t i = 0; i < changes_.size(); ++i) {
    const RigidTransform pose = perturbCamera(reference_, changes_[i]);
    poses_[i] = {pose, weights_[i]};
    const Eigen::Matrix3d rotation = pose.rotation.toRotationMatrix();
    for (int row = 0; row < 3; ++row) {
      for (int k = 0; k < 3; ++k) columns_[static_cast<std::size_t>(3 * row + k)][i] = rotation(row, k);
      columns_[static_cast<std::size_t>(9 + row)][i] = pose.translation[row];
    }
  }
}

}  // namespace helical
