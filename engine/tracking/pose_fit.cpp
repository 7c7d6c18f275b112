#include "engine/tracking/pose_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "engine/geometry/rotation.h"

namespace helical {
namespace {

struct Normal {
  Matrix6d hessian = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  double inlier_cost = 0.0;
  int named = 0;
  int inliers = 0;
};

double weight(double residual2, double scale_px) {
  if (scale_px <= 0.0) return 1.0;
  const double ratio2 = residual2 / (scale_px * scale_px);
  return ratio2 <= 1.0 ? 1.0 : 1.0 / (ratio2 * ratio2);
}

void accumulate(const NamedView& view, const MarkerLayout& markers, const RigidTransform& pose,
                double scale_px, double inlier_px, Normal& normal) {
  const Eigen::Matrix3d camera_from_world = view.camera_from_world.rotation.toRotationMatrix();
  for (int m = 0; m < markers.count(); ++m) {
    const int name = view.names[static_cast<std::size_t>(m)];
    if (name < 0) continue;
    ++normal.named;
    const Eigen::Vector3d& marker = markers.inBody(markerId(m));
    Eigen::Matrix<double, 2, 3> d_point;
    const auto pixel = view.camera->project(view.camera_from_world * (pose * marker), &d_point);
    if (!pixel) continue;
    const Eigen::Vector2d residual =
        *pixel - view.observation->centroids[static_cast<std::size_t>(name)].pixel;
    const Eigen::Matrix<double, 2, 3> d_world = d_point * camera_from_world;
    Eigen::Matrix<double, 2, 6> jacobian;
    jacobian.leftCols<3>() = d_world;
    jacobian.rightCols<3>() = -d_world * pose.rotation.toRotationMatrix() * hat(marker);
    const double residual2 = residual.squaredNorm();
    const double w = weight(residual2, scale_px);
    normal.hessian += w * jacobian.transpose() * jacobian;
    normal.gradient += w * jacobian.transpose() * residual;
    if (residual2 < inlier_px * inlier_px) {
      normal.inlier_cost += residual2;
      ++normal.inliers;
    }
  }
}

}  // namespace

PoseFit fitPose(std::span<const NamedView> views, const MarkerLayout& markers, const RigidTransform& initial,
                double scale_px, int iterations, double inlier_px) {
  PoseFit fit;
  fit.world_from_body = initial;
  for (int i = 0;; ++i) {
    Normal normal;
    for (const auto& view : views)
      accumulate(view, markers, fit.world_from_body, scale_px, inlier_px, normal);
    fit.information = normal.hessian;
    fit.named = normal.named;
    fit.inliers = normal.inliers;
    fit.rms_px = normal.inliers > 0 ? std::sqrt(normal.inlier_cost / (2.0 * normal.inliers)) : 0.0;
    if (normal.named < 3) return fit;
    if (i == iterations) break;
    Matrix6d damped = normal.hessian;
    damped.diagonal().array() += 1e-3;
    Vector6d step = -damped.ldlt().solve(normal.gradient);
    if (!step.allFinite()) return fit;
    step *= std::min(1.0, 0.5 / std::max(step.tail<3>().norm(), 1e-12));
    fit.world_from_body.translation += step.head<3>();
    fit.world_from_body.rotation = (fit.world_from_body.rotation * expSO3(step.tail<3>())).normalized();
    if (step.norm() < 1e-7) i = iterations - 1;
  }
  fit.ok = fit.world_from_body.translation.allFinite() && fit.inliers >= 3;
  return fit;
}

}  // namespace helical
