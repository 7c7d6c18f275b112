#include "engine/calibration/particle_cloud.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "engine/base/check.h"
#include "engine/calibration/resampling.h"
#include "engine/calibration/vector_math.h"
#include "engine/geometry/rotation.h"

namespace helical {
namespace {

constexpr double kReferenceDriftRad = 0.02;  // beyond, averages of rotation parameters lose accuracy
constexpr std::size_t kBlock = kParticleBlock;

using Changes = std::array<float*, 6>;
using ConstChanges = std::array<const float*, 6>;
using Matrix6f = Eigen::Matrix<float, 6, 6>;
using Vector6f = Eigen::Matrix<float, 6, 1>;

/// Square root of a covariance that may be singular up to rounding.
Matrix6d squareRoot(const Matrix6d& covariance) {
  Matrix6d regular = covariance;
  regular.diagonal().array() += 1e-18;
  return regular.llt().matrixL();
}

Eigen::Quaterniond rotationOf(const Eigen::Vector3d& parameters) {
  const double square = parameters.squaredNorm() / 16.0;
  Eigen::Quaterniond rotation;
  rotation.w() = (1.0 - square) / (1.0 + square);
  rotation.vec() = 0.5 * parameters / (1.0 + square);
  return rotation;
}

template <std::size_t N>
std::array<float*, N> data(std::array<std::vector<float>, N>& columns) {
  std::array<float*, N> pointers;
  for (std::size_t i = 0; i < N; ++i) pointers[i] = columns[i].data();
  return pointers;
}

/// changes = offset + scale * changes + root * noise; root is lower triangular.
HELICAL_VECTOR_CLONES
void spread(const Changes& changes, const Vector6f& offset, float scale, const Matrix6f& root,
            const Changes& noise, std::size_t count) {
  for (int row = 0; row < 6; ++row) {
    float* x = changes[static_cast<std::size_t>(row)];
    const float shift = offset[row];
    for (std::size_t i = 0; i < count; ++i) x[i] = shift + scale * x[i];
    for (int k = 0; k <= row; ++k) {
      const float factor = root(row, k);
      const float* n = noise[static_cast<std::size_t>(k)];
      for (std::size_t i = 0; i < count; ++i) x[i] += factor * n[i];
    }
  }
}

/// In a changed reference: rotations times the inverse of `turn` on their right, centres without `shift`.
HELICAL_VECTOR_CLONES
void refer(const Changes& changes, const Eigen::Quaternionf& turn, const Eigen::Vector3f& shift,
           std::size_t count) {
  const float aw = turn.w(), ax = -turn.x(), ay = -turn.y(), az = -turn.z();
  const auto [x, y, z, cx, cy, cz] = changes;
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    const float square = (x[i] * x[i] + y[i] * y[i] + z[i] * z[i]) * 0.0625F;
    const float inverse = 1.0F / (1.0F + square);
    const float w = (1.0F - square) * inverse;
    const float qx = 0.5F * x[i] * inverse, qy = 0.5F * y[i] * inverse, qz = 0.5F * z[i] * inverse;
    const float rw = w * aw - qx * ax - qy * ay - qz * az;
    const float rx = w * ax + qx * aw + qy * az - qz * ay;
    const float ry = w * ay + qy * aw + qz * ax - qx * az;
    const float rz = w * az + qz * aw + qx * ay - qy * ax;
    const float sign = rw < 0.0F ? -4.0F : 4.0F;  // of the two quaternions the one below half a turn
    const float factor = sign / (1.0F + (rw < 0.0F ? -rw : rw));
    x[i] = rx * factor;
    y[i] = ry * factor;
    z[i] = rz * factor;
  }
  const float shift_x = shift.x(), shift_y = shift.y(), shift_z = shift.z();
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    cx[i] -= shift_x;
    cy[i] -= shift_y;
    cz[i] -= shift_z;
  }
}

/// Rotation matrices and translations of the changes of a reference with rotation `r` and centre `c`.
HELICAL_VECTOR_CLONES
void place(const ConstChanges& changes, const Eigen::Matrix3f& r, const Eigen::Vector3f& c,
           const std::array<float*, 12>& columns, std::size_t count) {
  const float r00 = r(0, 0), r01 = r(0, 1), r02 = r(0, 2), r10 = r(1, 0), r11 = r(1, 1), r12 = r(1, 2),
              r20 = r(2, 0), r21 = r(2, 1), r22 = r(2, 2), c0 = c[0], c1 = c[1], c2 = c[2];
  const auto [x, y, z, cx, cy, cz] = changes;
  const auto [p00, p01, p02, p10, p11, p12, p20, p21, p22, t0, t1, t2] = columns;
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    const float square = (x[i] * x[i] + y[i] * y[i] + z[i] * z[i]) * 0.0625F;
    const float inverse = 1.0F / (1.0F + square);
    const float w = (1.0F - square) * inverse;
    const float qx = 0.5F * x[i] * inverse, qy = 0.5F * y[i] * inverse, qz = 0.5F * z[i] * inverse;
    const float m00 = 1.0F - 2.0F * (qy * qy + qz * qz), m01 = 2.0F * (qx * qy - w * qz),
                m02 = 2.0F * (qx * qz + w * qy), m10 = 2.0F * (qx * qy + w * qz),
                m11 = 1.0F - 2.0F * (qx * qx + qz * qz), m12 = 2.0F * (qy * qz - w * qx),
                m20 = 2.0F * (qx * qz - w * qy), m21 = 2.0F * (qy * qz + w * qx),
                m22 = 1.0F - 2.0F * (qx * qx + qy * qy);
    const float centre_x = c0 + cx[i], centre_y = c1 + cy[i], centre_z = c2 + cz[i];
    p00[i] = m00 * r00 + m01 * r10 + m02 * r20;
    p01[i] = m00 * r01 + m01 * r11 + m02 * r21;
    p02[i] = m00 * r02 + m01 * r12 + m02 * r22;
    p10[i] = m10 * r00 + m11 * r10 + m12 * r20;
    p11[i] = m10 * r01 + m11 * r11 + m12 * r21;
    p12[i] = m10 * r02 + m11 * r12 + m12 * r22;
    p20[i] = m20 * r00 + m21 * r10 + m22 * r20;
    p21[i] = m20 * r01 + m21 * r11 + m22 * r21;
    p22[i] = m20 * r02 + m21 * r12 + m22 * r22;
    t0[i] = -(p00[i] * centre_x + p01[i] * centre_y + p02[i] * centre_z);
    t1[i] = -(p10[i] * centre_x + p11[i] * centre_y + p12[i] * centre_z);
    t2[i] = -(p20[i] * centre_x + p21[i] * centre_y + p22[i] * centre_z);
  }
}

/// Sum of products of two blocks.
inline float dot(const float* a, const float* b) {
  std::array<float, kLanes> sums{};
  for (std::size_t i = 0; i < kBlock; i += kLanes)
    for (std::size_t k = 0; k < kLanes; ++k) sums[k] += a[i + k] * b[i + k];
  float sum = 0.0F;
  for (const float part : sums) sum += part;
  return sum;
}

HELICAL_VECTOR_CLONES
void addMean(const ConstChanges& changes, const float* weights, std::size_t count, Vector6d& mean) {
  for (std::size_t start = 0; start < count; start += kBlock) {
    const std::size_t size = std::min(kBlock, count - start);
    alignas(64) std::array<float, kBlock> w{}, x{};
    std::copy_n(weights + start, size, w.begin());
    for (int row = 0; row < 6; ++row) {
      std::copy_n(changes[static_cast<std::size_t>(row)] + start, size, x.begin());
      mean[row] += static_cast<double>(dot(w.data(), x.data()));
    }
  }
}

HELICAL_VECTOR_CLONES
void addCovariance(const ConstChanges& changes, const float* weights, const Vector6f& mean, std::size_t count,
                   Matrix6d& covariance) {
  alignas(64) std::array<std::array<float, kBlock>, 6> deviations, weighted;
  for (std::size_t start = 0; start < count; start += kBlock) {
    const std::size_t size = std::min(kBlock, count - start);
    for (std::size_t row = 0; row < 6; ++row) {
      const float middle = mean[static_cast<Eigen::Index>(row)];
      const float* x = changes[row] + start;
      if (size < kBlock) weighted[row].fill(0.0F);
      if (size < kBlock) deviations[row].fill(0.0F);
      for (std::size_t i = 0; i < size; ++i) {
        deviations[row][i] = x[i] - middle;
        weighted[row][i] = weights[start + i] * deviations[row][i];
      }
    }
    for (int row = 0; row < 6; ++row)
      for (int k = 0; k <= row; ++k)
        covariance(row, k) += static_cast<double>(dot(weighted[static_cast<std::size_t>(row)].data(),
                                                      deviations[static_cast<std::size_t>(k)].data()));
  }
}

HELICAL_VECTOR_CLONES
void addScaled(const float* a, float factor, const float* b, float* result, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) result[i] = a[i] + factor * b[i];
}

}  // namespace

ParticleCloud::ParticleCloud(int count, std::uint64_t random_seed)
    : random_(random_seed), deviates_(random_seed) {
  HELICAL_CHECK(count >= 2);
  const auto size = static_cast<std::size_t>(count);
  for (Column& column : changes_) column.resize(size);
  for (Column& column : spare_) column.resize(size);
  // Whole blocks; what is too many stays 0, behind the camera.
  for (Column& column : columns_)
    column.resize((size + kParticleBlock - 1) / kParticleBlock * kParticleBlock);
  log_weights_.resize(size);
  trial_log_weights_.resize(size);
  weights_.resize(size);
  trial_weights_.resize(size);
  parents_.resize(size);
  poses_.resize(size);
  restart(random_seed);
}

void ParticleCloud::restart(std::uint64_t random_seed) {
  random_ = Random(random_seed);
  deviates_ = NormalDeviates(random_.fork(1).bits());
  seed({}, Matrix6d::Zero());
}

void ParticleCloud::startEqual() {
  std::fill(log_weights_.begin(), log_weights_.end(), 0.0F);
  std::fill(weights_.begin(), weights_.end(), 1.0F / static_cast<float>(count()));
  effective_ = count();
}

void ParticleCloud::disperse(const Vector6d& offset, double scale, const Matrix6d& root) {
  for (Column& column : spare_) deviates_.fill(column);
  spread(data(changes_), offset.cast<float>(), static_cast<float>(scale), root.cast<float>(), data(spare_),
         log_weights_.size());
}

void ParticleCloud::seed(const RigidTransform& mean, const Matrix6d& covariance) {
  reference_ = mean;
  for (Column& column : changes_) std::fill(column.begin(), column.end(), 0.0F);
  disperse(Vector6d::Zero(), 0.0, squareRoot(covariance));
  startEqual();
  updateColumns();
}

double ParticleCloud::effectiveSampleSizeAfter(std::span<const float> log_likelihoods, double exponent) {
  addScaled(log_weights_.data(), static_cast<float>(exponent), log_likelihoods.data(),
            trial_log_weights_.data(), log_weights_.size());
  trial_largest_ = normaliseLogWeights(trial_log_weights_, trial_weights_);
  return helical::effectiveSampleSize(trial_weights_);
}

void ParticleCloud::reweigh(std::span<const float> log_likelihoods, double exponent) {
  effective_ = effectiveSampleSizeAfter(log_likelihoods, exponent);
  weights_.swap(trial_weights_);
  // Kept below 0, where single precision is best.
  for (std::size_t i = 0; i < log_weights_.size(); ++i)
    log_weights_[i] = trial_log_weights_[i] - trial_largest_;
}

CloudMoments ParticleCloud::moments() const {
  CloudMoments moments;
  ConstChanges changes;
  for (std::size_t row = 0; row < 6; ++row) changes[row] = changes_[row].data();
  addMean(changes, weights_.data(), weights_.size(), moments.mean);
  addCovariance(changes, weights_.data(), moments.mean.cast<float>(), weights_.size(), moments.covariance);
  moments.covariance = moments.covariance.selfadjointView<Eigen::Lower>();
  return moments;
}

RigidTransform ParticleCloud::pose(const Vector6d& perturbation) const {
  RigidTransform moved;
  moved.rotation = (rotationOf(perturbation.head<3>()) * reference_.rotation).normalized();
  moved.translation = -(moved.rotation * (reference_.inverseTranslation() + perturbation.tail<3>()));
  return moved;
}

std::span<const WeightedPose> ParticleCloud::poses() {
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    Vector6d change;
    for (std::size_t row = 0; row < 6; ++row)
      change[static_cast<Eigen::Index>(row)] = static_cast<double>(changes_[row][i]);
    poses_[i] = {pose(change), static_cast<double>(weights_[i])};
  }
  return poses_;
}

void ParticleCloud::resample(double kernel) {
  const CloudMoments before = moments();
  systematicResample(weights_, random_.uniform(), parents_);
  for (std::size_t row = 0; row < 6; ++row) {
    for (std::size_t i = 0; i < parents_.size(); ++i)
      spare_[row][i] = changes_[row][static_cast<std::size_t>(parents_[i])];
    changes_[row].swap(spare_[row]);
  }
  if (kernel > 0.0) {
    const double shrink = std::sqrt(1.0 - kernel * kernel);
    disperse((1.0 - shrink) * before.mean, shrink, kernel * squareRoot(before.covariance));
  }
  startEqual();
  if (before.mean.head<3>().norm() > kReferenceDriftRad) moveReference(before.mean);
  updateColumns();
}

void ParticleCloud::moveReference(const Vector6d& mean) {
  refer(data(changes_), rotationOf(mean.head<3>()).cast<float>(), mean.tail<3>().cast<float>(),
        log_weights_.size());
  reference_ = pose(mean);
}

void ParticleCloud::updateColumns() {
  ConstChanges changes;
  for (std::size_t row = 0; row < 6; ++row) changes[row] = changes_[row].data();
  place(changes, reference_.rotation.toRotationMatrix().cast<float>(),
        reference_.inverseTranslation().cast<float>(), data(columns_), log_weights_.size());
}

}  // namespace helical
