#include "engine/geometry/ceres_resection.h"

#include <ceres/ceres.h>

#include <array>
#include <cmath>

#include "engine/geometry/camera_perturbation.h"
#include "engine/geometry/quiet_ceres.h"

namespace helical {
namespace {

/// Residual of one point over the perturbation of the initial pose.
class PointResidual final : public ceres::SizedCostFunction<2, 6> {
 public:
  PointResidual(const CameraModel& camera, const WorldPoint& point, const RigidTransform& initial)
      : camera_(camera), point_(point), initial_(initial) {}

  bool Evaluate(const double* const* parameters, double* residuals, double** jacobians) const override {
    const Eigen::Map<const Vector6d> perturbation(parameters[0]);
    Eigen::Map<Eigen::Vector2d> residual(residuals);
    Eigen::Matrix<double, 2, 6> local;
    const auto seen = resectionResidual(camera_, point_, perturbCamera(initial_, perturbation),
                                        jacobians ? &local : nullptr);
    residual = seen.value_or(Eigen::Vector2d(std::sqrt(kUnseenResidual2), 0.0));
    if (!jacobians || !jacobians[0]) return true;
    Eigen::Map<Eigen::Matrix<double, 2, 6, Eigen::RowMajor>> jacobian(jacobians[0]);
    jacobian.setZero();
    if (!seen) return true;
    // exp(w + dw) = exp(Jl(w) dw) exp(w), and the left Jacobian at w is the right one at -w.
    jacobian.leftCols<3>() = local.leftCols<3>() * rightJacobianSO3(-perturbation.head<3>());
    jacobian.rightCols<3>() = local.rightCols<3>();
    return true;
  }

 private:
  const CameraModel& camera_;
  const WorldPoint& point_;
  const RigidTransform& initial_;
};

/// k^2 (2 - k^2 / s) beyond k^2.
class RedescendingLoss final : public ceres::LossFunction {
 public:
  explicit RedescendingLoss(double scale) : scale2_(scale * scale) {}

  void Evaluate(double s, double out[3]) const override {
    if (s <= scale2_) {
      out[0] = s, out[1] = 1.0, out[2] = 0.0;
      return;
    }
    const double ratio = scale2_ / s;
    out[0] = scale2_ * (2.0 - ratio);
    out[1] = ratio * ratio;
    out[2] = -2.0 * ratio * ratio / s;
  }

 private:
  double scale2_;
};

ResectionStatus statusOf(const ceres::Solver::Summary& summary) {
  switch (summary.termination_type) {
    case ceres::CONVERGENCE:
      return ResectionStatus::kConverged;
    case ceres::NO_CONVERGENCE:
      return ResectionStatus::kIterationLimit;
    default:
      return ResectionStatus::kDiverged;
  }
}

}  // namespace

ResectionSolution solveByCeres(const CameraModel& camera, std::span<const WorldPoint> points,
                               const RigidTransform& initial, const ResectionOptions& options) {
  Vector6d perturbation = Vector6d::Zero();
  ceres::Problem problem;
  for (const auto& point : points)
    problem.AddResidualBlock(
        new PointResidual(camera, point, initial),
        options.robust_scale_px > 0.0 ? new RedescendingLoss(options.robust_scale_px) : nullptr,
        perturbation.data());
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.max_num_iterations = options.max_iterations;
  solver.function_tolerance = 1e-14;
  solver.gradient_tolerance = 1e-14;
  solver.parameter_tolerance = 1e-10;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  quietCeres();
  ceres::Solve(solver, &problem, &summary);
  return {perturbCamera(initial, perturbation), static_cast<int>(summary.iterations.size()),
          statusOf(summary)};
}

}  // namespace helical
