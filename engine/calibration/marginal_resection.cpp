#include "engine/calibration/marginal_resection.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/calibration/camera_perturbation.h"
#include "engine/geometry/camera_perturbation.h"

namespace helical {
namespace {

constexpr double kUnseenCost = 1e6;      // squared sigmas, where a ball would be behind the camera
constexpr double kFarthestM = 50.0;      // a solution beyond has diverged
constexpr double kMedianToScale = 2.5;   // 1.18 sigma is the median of a good fit: stays below the scale
constexpr double kConvergedStep = 1e-7;  // rad and m

using Normal = ResectionRun::Normal;
using Residuals = ResectionRun::Residuals;
using Matrix67d = Eigen::Matrix<double, 6, 7>;

struct Loss {
  double cost;
  double weight;
};

/// r^2 up to k^2, then rising to 2 k^2; its derivative is the weight (k / r)^4.
Loss loss(double squared, double scale) {
  const double limit = scale * scale;
  if (scale <= 0.0 || squared <= limit) return {squared, 1.0};
  const double ratio = limit / squared;
  return {limit * (2.0 - ratio), ratio * ratio};
}

/// Lower triangular root of a positive semidefinite matrix (Cholesky); zero where it is zero.
Matrix6d triangularRoot(const Matrix6d& matrix) {
  Matrix6d root = Matrix6d::Zero();
  for (int k = 0; k < 6; ++k) {
    double pivot = matrix(k, k);
    for (int j = 0; j < k; ++j) pivot -= root(k, j) * root(k, j);
    if (!(pivot > 0.0)) continue;
    root(k, k) = std::sqrt(pivot);
    const double inverse = 1.0 / root(k, k);
    for (int i = k + 1; i < 6; ++i) {
      double sum = matrix(i, k);
      for (int j = 0; j < k; ++j) sum -= root(i, j) * root(k, j);
      root(i, k) = sum * inverse;
    }
  }
  return root;
}

/// right = root^-1 right, row by row: Eigen's solver of general size takes three times as long.
void substituteForward(const Matrix6d& root, Matrix67d& right) {
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < i; ++j) right.row(i) -= root(i, j) * right.row(j);
    right.row(i) *= 1.0 / root(i, i);
  }
}

void addFrame(const CameraModel& camera, const MarkerLayout& markers, const StoredFrame& frame,
              const RigidTransform& pose, double scale, Normal& total, Residuals& residuals) {
  Matrix6d camera_camera = Matrix6d::Zero(), pose_camera = Matrix6d::Zero(), pose_pose = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero(), pose_gradient = Vector6d::Zero();
  for (int i = 0; i < frame.count; ++i) {
    const LabelledPixel& seen = frame.pixels[static_cast<std::size_t>(i)];
    const auto projection = projectMarker(camera, pose, frame.world_from_body, markers.inBody(seen.marker));
    ++total.terms;
    if (!projection) {
      total.cost += loss(kUnseenCost, scale).cost;
      continue;
    }
    const Eigen::Matrix2d information = seen.covariance.inverse();
    const Eigen::Vector2d residual = projection->pixel - seen.pixel;
    const double squared = residual.dot(information * residual);
    const Loss robust = loss(squared, scale);
    const Eigen::Matrix<double, 6, 2> camera_weighted =
        robust.weight * projection->d_camera.transpose() * information;
    const Eigen::Matrix<double, 6, 2> pose_weighted =
        robust.weight * projection->d_pose.transpose() * information;
    camera_camera.noalias() += camera_weighted * projection->d_camera;
    pose_camera.noalias() += pose_weighted * projection->d_camera;
    pose_pose.noalias() += pose_weighted * projection->d_pose;
    gradient.noalias() += camera_weighted * residual;
    pose_gradient.noalias() += pose_weighted * residual;
    total.cost += robust.cost;
    if (residuals.count < residuals.squared.size()) residuals.squared[residuals.count++] = squared;
  }
  total.hessian += camera_camera;
  total.gradient += gradient;
  // With P = L L^T, (P^-1 + A)^-1 = L (I + L^T A L)^-1 L^T: holds also for a pose known exactly, P = 0.
  const Matrix6d root = triangularRoot(frame.pose_covariance);
  Matrix6d inner = Matrix6d::Identity();
  inner.noalias() += root.transpose() * Matrix6d(pose_pose * root);
  Matrix67d coupling;
  coupling.leftCols<6>().noalias() = root.transpose() * pose_camera;
  coupling.col(6).noalias() = root.transpose() * pose_gradient;
  substituteForward(triangularRoot(inner), coupling);
  const auto absorbed = coupling.leftCols<6>();
  total.hessian.noalias() -= absorbed.transpose() * absorbed;
  total.gradient.noalias() -= absorbed.transpose() * coupling.col(6);
  total.cost -= coupling.col(6).squaredNorm();
}

double robustScale(Residuals& residuals, double robust_sigmas) {
  if (robust_sigmas <= 0.0 || residuals.count == 0) return robust_sigmas;
  const auto first = residuals.squared.begin();
  const auto middle = first + static_cast<std::ptrdiff_t>(residuals.count / 2);
  std::nth_element(first, middle, first + static_cast<std::ptrdiff_t>(residuals.count));
  return std::max(robust_sigmas, kMedianToScale * std::sqrt(*middle));
}

}  // namespace

void ResectionRun::start(std::span<const StoredFrame* const> frames, const RigidTransform& initial,
                         const MarginalResectionOptions& options) {
  frames_ = frames;
  options_ = options;
  result_ = {};
  result_.camera_from_world = initial;
  scale_ = options.robust_sigmas;
  damping_ = options.damped ? 1e-3 : 0.0;
  iteration_ = 0;
  beginPass(Pass::kInitial, initial);
}

void ResectionRun::advance(const CameraModel& camera, const MarkerLayout& markers, int& budget) {
  while (running()) {
    for (; next_frame_ < frames_.size(); ++next_frame_, --budget) {
      if (budget <= 0) return;
      addFrame(camera, markers, *frames_[next_frame_], evaluated_, scale_, sum_, residuals_);
    }
    finishPass();
  }
}

void ResectionRun::beginPass(Pass pass, const RigidTransform& pose) {
  pass_ = pass;
  evaluated_ = pose;
  next_frame_ = 0;
  sum_ = {};
  residuals_.count = 0;
}

void ResectionRun::finishPass() {
  switch (pass_) {
    case Pass::kNone:
      break;
    case Pass::kInitial:
      current_ = sum_;
      iterate();
      break;
    case Pass::kRescaled:
      current_ = sum_;
      takeStep();
      break;
    case Pass::kTrial:
      judgeTrial();
      break;
    case Pass::kFinal:
      current_ = sum_;
      conclude();
      break;
  }
}

void ResectionRun::iterate() {
  if (iteration_++ >= options_.iterations) return finish();
  const double wanted = robustScale(residuals_, options_.robust_sigmas);
  if (!(std::abs(wanted - scale_) > 0.05 * scale_)) return takeStep();
  scale_ = wanted;
  beginPass(Pass::kRescaled, result_.camera_from_world);
}

void ResectionRun::takeStep() {
  Matrix6d damped = current_.hessian;
  damped.diagonal() *= 1.0 + damping_;
  step_ = -damped.ldlt().solve(current_.gradient);
  if (step_.allFinite())
    beginPass(Pass::kTrial, perturbCamera(result_.camera_from_world, step_));
  else
    pass_ = Pass::kNone;
}

void ResectionRun::judgeTrial() {
  const bool settled = step_.norm() < kConvergedStep;
  if (options_.damped && !(sum_.cost < current_.cost)) {
    damping_ = std::max(damping_ * 8.0, 1e-6);
    return damping_ > 1e8 || settled ? finish() : iterate();
  }
  damping_ *= 0.2;
  result_.camera_from_world = evaluated_;
  current_ = sum_;
  settled ? finish() : iterate();
}

void ResectionRun::finish() {
  if (!(scale_ > options_.robust_sigmas)) return conclude();
  scale_ = options_.robust_sigmas;
  beginPass(Pass::kFinal, result_.camera_from_world);
}

void ResectionRun::conclude() {
  pass_ = Pass::kNone;
  result_.information = current_.hessian;
  result_.cost = current_.cost;
  result_.terms = current_.terms;
  const Eigen::LDLT<Matrix6d> factor(current_.hessian);
  result_.ok = current_.terms >= 3 && current_.hessian.allFinite() && factor.isPositive() &&
               factor.vectorD().minCoeff() > 0.0 &&
               result_.camera_from_world.inverseTranslation().norm() < kFarthestM;
}

MarginalResection resect(const CameraModel& camera, const MarkerLayout& markers,
                         std::span<const StoredFrame* const> frames, const RigidTransform& initial,
                         const MarginalResectionOptions& options) {
  ResectionRun run;
  run.start(frames, initial, options);
  int budget = std::numeric_limits<int>::max();
  run.advance(camera, markers, budget);
  return run.result();
}

}  // namespace helical
