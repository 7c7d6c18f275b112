#include "engine/calibration/marginal_resection.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "engine/calibration/camera_perturbation.h"
#include "engine/geometry/camera_perturbation.h"

namespace helical {
namespace {

constexpr double kUnseenCost = 1e6;       // squared sigmas, where a ball would be behind the camera
constexpr double kFarthestM = 50.0;       // a solution beyond has diverged
constexpr double kMedianToScale = 2.5;    // 1.18 sigma is the median of a good fit: stays below the scale
constexpr double kConvergedStep = 1e-7;   // rad and m
constexpr std::size_t kMaxSampled = 512;  // residuals that the median is taken from

/// Normal equations of one frame or of all.
struct Normal {
  Matrix6d hessian = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  double cost = 0.0;
  int terms = 0;
};

struct Residuals {
  std::array<double, kMaxSampled> squared;
  std::size_t count = 0;
};

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
    if (residuals.count < kMaxSampled) residuals.squared[residuals.count++] = squared;
  }
  // (P^-1 + A)^-1 = P (I + A P)^-1 holds also for a pose that is known exactly, P = 0.
  const Matrix6d& covariance = frame.pose_covariance;
  Matrix6d inner = Matrix6d::Identity();
  inner.noalias() += pose_pose * covariance;
  const Eigen::PartialPivLU<Matrix6d> solver(inner);
  const Matrix6d absorbed = covariance * solver.solve(pose_camera);
  const Vector6d absorbed_gradient = covariance * solver.solve(pose_gradient);
  total.hessian += camera_camera;
  total.hessian.noalias() -= pose_camera.transpose() * absorbed;
  total.gradient += gradient;
  total.gradient.noalias() -= pose_camera.transpose() * absorbed_gradient;
  total.cost -= pose_gradient.dot(absorbed_gradient);
}

Normal evaluate(const CameraModel& camera, const MarkerLayout& markers,
                std::span<const StoredFrame* const> frames, const RigidTransform& pose, double scale,
                Residuals& residuals) {
  Normal total;
  residuals.count = 0;
  for (const StoredFrame* frame : frames) addFrame(camera, markers, *frame, pose, scale, total, residuals);
  return total;
}

double robustScale(Residuals& residuals, double robust_sigmas) {
  if (robust_sigmas <= 0.0 || residuals.count == 0) return robust_sigmas;
  const auto first = residuals.squared.begin();
  const auto middle = first + static_cast<std::ptrdiff_t>(residuals.count / 2);
  std::nth_element(first, middle, first + static_cast<std::ptrdiff_t>(residuals.count));
  return std::max(robust_sigmas, kMedianToScale * std::sqrt(*middle));
}

}  // namespace

MarginalResection resect(const CameraModel& camera, const MarkerLayout& markers,
                         std::span<const StoredFrame* const> frames, const RigidTransform& initial,
                         const MarginalResectionOptions& options) {
  MarginalResection result;
  result.camera_from_world = initial;
  Residuals residuals;
  double scale = options.robust_sigmas;
  Normal current = evaluate(camera, markers, frames, initial, scale, residuals);
  double damping = options.damped ? 1e-3 : 0.0;
  for (int i = 0; i < options.iterations; ++i) {
    const double wanted_scale = robustScale(residuals, options.robust_sigmas);
    if (std::abs(wanted_scale - scale) > 0.05 * scale) {
      scale = wanted_scale;
      current = evaluate(camera, markers, frames, result.camera_from_world, scale, residuals);
    }
    Matrix6d damped = current.hessian;
    damped.diagonal() *= 1.0 + damping;
    const Vector6d step = -damped.ldlt().solve(current.gradient);
    if (!step.allFinite()) return result;
    const RigidTransform trial = perturbCamera(result.camera_from_world, step);
    const Normal next = evaluate(camera, markers, frames, trial, scale, residuals);
    if (options.damped && !(next.cost < current.cost)) {
      damping = std::max(damping * 8.0, 1e-6);
      if (damping > 1e8 || step.norm() < kConvergedStep) break;
      continue;
    }
    damping *= 0.2;
    result.camera_from_world = trial;
    current = next;
    if (step.norm() < kConvergedStep) break;
  }
  if (scale > options.robust_sigmas)
    current = evaluate(camera, markers, frames, result.camera_from_world, options.robust_sigmas, residuals);
  result.information = current.hessian;
  result.cost = current.cost;
  result.terms = current.terms;
  const Eigen::LDLT<Matrix6d> factor(current.hessian);
  result.ok = current.terms >= 3 && current.hessian.allFinite() && factor.isPositive() &&
              factor.vectorD().minCoeff() > 0.0 &&
              result.camera_from_world.inverseTranslation().norm() < kFarthestM;
  return result;
}

}  // namespace helical
