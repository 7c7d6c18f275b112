#include "engine/geometry/camera_resection.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

#include "engine/base/error.h"
#include "engine/geometry/camera_perturbation.h"
#include "engine/geometry/ceres_resection.h"

namespace helical {
namespace {

constexpr double kRestingStep = 1e-9;  // rad and m: far below what pixels can tell
constexpr double kLargestStep = 1e3;   // rad and m: beyond it Gauss-Newton has lost the camera
constexpr double kLargestDamping = 1e9;
constexpr double kLargestCondition = 1e13;

struct Evaluation {
  Matrix6d hessian = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  double cost = 0.0;
  double inlier_cost = 0.0;
  int inliers = 0;
};

double robustWeight(double residual2, double scale) {
  if (scale <= 0.0 || residual2 <= scale * scale) return 1.0;
  const double ratio = scale * scale / residual2;
  return ratio * ratio;
}

double robustCost(double residual2, double scale) {
  if (scale <= 0.0 || residual2 <= scale * scale) return residual2;
  return scale * scale * (2.0 - scale * scale / residual2);
}

Evaluation evaluate(const CameraModel& camera, std::span<const WorldPoint> points, const RigidTransform& pose,
                    double scale) {
  Evaluation result;
  for (const auto& point : points) {
    Eigen::Matrix<double, 2, 6> jacobian;
    const auto residual = resectionResidual(camera, point, pose, &jacobian);
    if (!residual) {
      result.cost += robustCost(kUnseenResidual2, scale);
      continue;
    }
    const double residual2 = residual->squaredNorm();
    const double weight = robustWeight(residual2, scale);
    result.hessian.noalias() += weight * jacobian.transpose() * jacobian;
    result.gradient.noalias() += weight * jacobian.transpose() * *residual;
    result.cost += robustCost(residual2, scale);
    if (scale <= 0.0 || residual2 <= scale * scale) {
      result.inlier_cost += residual2;
      ++result.inliers;
    }
  }
  return result;
}

ResectionSolution solveByGaussNewton(const CameraModel& camera, std::span<const WorldPoint> points,
                                     const RigidTransform& initial, const ResectionOptions& options) {
  ResectionSolution solution{initial, 0, ResectionStatus::kIterationLimit};
  while (solution.iterations < options.max_iterations) {
    ++solution.iterations;
    const Evaluation now = evaluate(camera, points, solution.camera_from_world, options.robust_scale_px);
    const Vector6d step = -now.hessian.ldlt().solve(now.gradient);
    if (!step.allFinite() || step.norm() > kLargestStep) {
      solution.status = ResectionStatus::kDiverged;
      return solution;
    }
    solution.camera_from_world = perturbCamera(solution.camera_from_world, step);
    if (step.norm() < kRestingStep) {
      solution.status = ResectionStatus::kConverged;
      return solution;
    }
  }
  return solution;
}

ResectionSolution solveByLevenbergMarquardt(const CameraModel& camera, std::span<const WorldPoint> points,
                                            const RigidTransform& initial, const ResectionOptions& options) {
  ResectionSolution solution{initial, 0, ResectionStatus::kIterationLimit};
  Evaluation now = evaluate(camera, points, initial, options.robust_scale_px);
  double damping = 1e-3;
  while (solution.iterations < options.max_iterations) {
    ++solution.iterations;
    Matrix6d damped = now.hessian;
    damped.diagonal() *= 1.0 + damping;
    damped.diagonal().array() += 1e-9;
    const Vector6d step = -damped.ldlt().solve(now.gradient);
    if (!step.allFinite()) {
      solution.status = ResectionStatus::kDiverged;
      return solution;
    }
    const RigidTransform trial_pose = perturbCamera(solution.camera_from_world, step);
    const Evaluation trial = evaluate(camera, points, trial_pose, options.robust_scale_px);
    const bool resting = step.norm() < kRestingStep;
    if (trial.cost < now.cost) {
      const bool settled = now.cost - trial.cost < 1e-12 * now.cost;
      solution.camera_from_world = trial_pose;
      now = trial;
      damping *= 0.2;
      if (settled) solution.status = ResectionStatus::kConverged;
    } else {
      damping *= 6.0;
      if (damping > kLargestDamping) solution.status = ResectionStatus::kConverged;
    }
    if (resting) solution.status = ResectionStatus::kConverged;
    if (solution.status == ResectionStatus::kConverged) return solution;
  }
  return solution;
}

ResectionSolution solve(const CameraModel& camera, std::span<const WorldPoint> points,
                        const RigidTransform& initial, const ResectionOptions& options) {
  switch (options.method) {
    case ResectionMethod::kGaussNewton:
      return solveByGaussNewton(camera, points, initial, options);
    case ResectionMethod::kCeres:
      return solveByCeres(camera, points, initial, options);
    case ResectionMethod::kLevenbergMarquardt:
      break;
  }
  return solveByLevenbergMarquardt(camera, points, initial, options);
}

/// Inverse of the information, or nothing where the points leave a direction of the pose open.
std::optional<Matrix6d> inverseOf(const Matrix6d& information) {
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(information);
  const Vector6d& values = eigen.eigenvalues();
  if (!(values[0] > values[5] / kLargestCondition) || !values.allFinite()) return std::nullopt;
  return eigen.eigenvectors() * values.cwiseInverse().asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace

void validate(const ResectionOptions& options) {
  if (options.max_iterations < 1)
    throw Error(ErrorKind::kInput, "resection has no iterations", {}, "give max_iterations of 1 or more");
  if (!(options.robust_scale_px >= 0.0) || !std::isfinite(options.robust_scale_px))
    throw Error(ErrorKind::kInput, "the robust scale is negative or no number", {},
                "give pixels, or 0 for none");
  if (!(options.sigma_px > 0.0) || !std::isfinite(options.sigma_px))
    throw Error(ErrorKind::kInput, "the centroid sigma is not positive", {}, "give pixels");
}

std::optional<Eigen::Vector2d> resectionResidual(const CameraModel& camera, const WorldPoint& point,
                                                 const RigidTransform& camera_from_world,
                                                 Eigen::Matrix<double, 2, 6>* jacobian) {
  const Eigen::Matrix3d rotation = camera_from_world.rotation.toRotationMatrix();
  const Eigen::Vector3d in_camera = rotation * point.in_world + camera_from_world.translation;
  Eigen::Matrix<double, 2, 3> d_point;
  const auto pixel = camera.project(in_camera, jacobian ? &d_point : nullptr);
  if (!pixel) return std::nullopt;
  if (jacobian) {
    jacobian->leftCols<3>() = -d_point * hat(in_camera);
    jacobian->rightCols<3>() = -d_point * rotation;
  }
  return *pixel - point.pixel;
}

Resection resectCamera(const CameraModel& camera, std::span<const WorldPoint> points,
                       const RigidTransform& initial, const ResectionOptions& options) {
  Resection result;
  result.camera_from_world = initial;
  if (points.size() < 3) return result;
  const ResectionSolution solution = solve(camera, points, initial, options);
  const Evaluation at_rest = evaluate(camera, points, solution.camera_from_world, options.robust_scale_px);
  result.camera_from_world = solution.camera_from_world;
  result.iterations = solution.iterations;
  result.status = solution.status;
  result.cost_px2 = at_rest.cost;
  result.inliers = at_rest.inliers;
  if (at_rest.inliers > 0) result.rms_px = std::sqrt(at_rest.inlier_cost / (2.0 * at_rest.inliers));
  const bool hidden = options.robust_scale_px <= 0.0 && at_rest.inliers < static_cast<int>(points.size());
  if (hidden || at_rest.inliers < 3 || !std::isfinite(at_rest.cost)) {
    result.status = ResectionStatus::kDiverged;
    return result;
  }
  if (const auto inverse = inverseOf(at_rest.hessian))
    result.covariance = options.sigma_px * options.sigma_px * *inverse;
  else if (result.status != ResectionStatus::kDiverged)
    result.status = ResectionStatus::kDegenerate;
  return result;
}

}  // namespace helical
