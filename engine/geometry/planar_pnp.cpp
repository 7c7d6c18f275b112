#include "engine/geometry/planar_pnp.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/check.h"
#include "engine/base/ids.h"
#include "engine/geometry/camera_estimate.h"
#include "engine/geometry/rotation.h"

namespace helical {
namespace {

constexpr int kIterations = 12;
constexpr double kUnseen = 1e12;

/// Squared reprojection error and the normal equations of the perturbation (rotation on the left
/// in the camera frame, then translation).
double evaluate(const CameraModel& camera, std::span<const Eigen::Vector3d> points,
                std::span<const Eigen::Vector2d> pixels, const RigidTransform& camera_from_body,
                Matrix6d* hessian, Vector6d* gradient) {
  hessian->setZero();
  gradient->setZero();
  double cost = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d rotated = camera_from_body.rotation * points[i];
    Eigen::Matrix<double, 2, 3> d_point;
    const auto pixel = camera.project(rotated + camera_from_body.translation, &d_point);
    if (!pixel) return kUnseen;
    const Eigen::Vector2d residual = *pixel - pixels[i];
    Eigen::Matrix<double, 2, 6> jacobian;
    jacobian.leftCols<3>() = -d_point * hat(rotated);
    jacobian.rightCols<3>() = d_point;
    *hessian += jacobian.transpose() * jacobian;
    *gradient += jacobian.transpose() * residual;
    cost += residual.squaredNorm();
  }
  return cost;
}

PlanarPose refine(const CameraModel& camera, std::span<const Eigen::Vector3d> points,
                  std::span<const Eigen::Vector2d> pixels, RigidTransform pose) {
  Matrix6d hessian, trial_hessian;
  Vector6d gradient, trial_gradient;
  double cost = evaluate(camera, points, pixels, pose, &hessian, &gradient);
  double damping = 1e-3;
  for (int i = 0; i < kIterations && cost < kUnseen; ++i) {
    Matrix6d damped = hessian;
    damped.diagonal() *= 1.0 + damping;
    const Vector6d step = -damped.ldlt().solve(gradient);
    if (!step.allFinite()) break;
    const RigidTransform trial{(expSO3(step.head<3>()) * pose.rotation).normalized(),
                               pose.translation + step.tail<3>()};
    const double trial_cost = evaluate(camera, points, pixels, trial, &trial_hessian, &trial_gradient);
    if (trial_cost < cost) {
      const bool converged = cost - trial_cost < 1e-9 * cost;
      pose = trial;
      cost = trial_cost;
      hessian = trial_hessian;
      gradient = trial_gradient;
      damping *= 0.2;
      if (converged) break;
    } else {
      damping *= 8.0;
      if (damping > 1e8) break;
    }
  }
  return {pose, std::sqrt(cost / (2.0 * static_cast<double>(points.size())))};
}

/// Homography from plane coordinates to bearings: the eigenvector of the smallest eigenvalue of A^T A.
Eigen::Matrix3d homography(std::span<const Eigen::Vector3d> points, std::span<const Eigen::Vector2d> bearings,
                           double scale) {
  Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = points[i].x() / scale, y = points[i].y() / scale;
    const double u = bearings[i].x(), v = bearings[i].y();
    Eigen::Matrix<double, 2, 9> rows;
    rows << x, y, 1, 0, 0, 0, -u * x, -u * y, -u, 0, 0, 0, x, y, 1, -v * x, -v * y, -v;
    normal += rows.transpose() * rows;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> solver(normal);
  const Eigen::Matrix<double, 9, 1> h = solver.eigenvectors().col(0);
  Eigen::Matrix3d result;
  result << h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], h[8];
  return result;
}

Eigen::Quaterniond nearestRotation(const Eigen::Matrix3d& m) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1.0 : 1.0;
  const Eigen::Matrix3d rotation =
      svd.matrixU() * Eigen::Vector3d(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
  return Eigen::Quaterniond(rotation);
}

/// Whether all points lie before the camera under this homography. Where noise has put a point over the line of two
/// others, it bends the plane through the camera instead.
bool seesAll(const Eigen::Matrix3d& homography, std::span<const Eigen::Vector3d> points) {
  return std::all_of(points.begin(), points.end(), [&](const Eigen::Vector3d& point) {
    return homography.row(2).dot(Eigen::Vector3d(point.x(), point.y(), 1.0)) > 0.0;
  });
}

/// As if all points were equally far away: rough, but hardly moved by noise.
RigidTransform byWeakPerspective(std::span<const Eigen::Vector3d> points, std::span<const Eigen::Vector2d> bearings,
                                 const Eigen::Vector3d& centre) {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& bearing : bearings) middle += bearing / static_cast<double>(bearings.size());
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero(), image = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d from_centre = (points[i] - centre).head<2>();
    spread += from_centre * from_centre.transpose();
    image += (bearings[i] - middle) * from_centre.transpose();
  }
  const Eigen::Matrix2d affine = image * spread.inverse();
  const double per_metre = Eigen::JacobiSVD<Eigen::Matrix2d>(affine).singularValues()[0];
  const Eigen::Matrix2d seen = affine / per_metre;
  const Eigen::Array2d depth = (1.0 - seen.colwise().squaredNorm().transpose().array()).max(0.0).sqrt();
  Eigen::Matrix3d axes;
  axes.col(0) << seen.col(0), depth[0];
  axes.col(1) << seen.col(1), std::copysign(depth[1], -seen.col(0).dot(seen.col(1)));
  axes.col(2) = axes.col(0).cross(axes.col(1));
  RigidTransform pose;
  pose.rotation = nearestRotation(axes);
  pose.translation = Eigen::Vector3d(middle.x(), middle.y(), 1.0) / per_metre - pose.rotation * centre;
  return pose;
}

}  // namespace

PlanarPoses solvePlanarPnp(const CameraModel& camera, std::span<const Eigen::Vector3d> points,
                           std::span<const Eigen::Vector2d> pixels) {
  HELICAL_CHECK(points.size() == pixels.size() && points.size() >= 4 && points.size() <= kMaxMarkers);
  std::array<Eigen::Vector2d, kMaxMarkers> bearings;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double scale = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    bearings[i] = camera.bearing(pixels[i]);
    centre += points[i] / static_cast<double>(points.size());
    scale = std::max(scale, points[i].head<2>().norm());
  }
  PlanarPoses result;
  if (!(scale > 0.0)) return result;

  Eigen::Matrix3d h = homography(points, {bearings.data(), points.size()}, scale);
  h.leftCols<2>() /= scale;
  const double norm = h.col(0).norm() + h.col(1).norm();
  if (!(norm > 1e-12)) return result;
  h *= 2.0 / norm;
  if (h(2, 2) < 0.0) h = -h;  // the target is in front of the camera

  Eigen::Matrix3d axes;
  axes << h.col(0), h.col(1), h.col(0).cross(h.col(1));
  RigidTransform first;
  first.rotation = nearestRotation(axes);
  first.translation = h.col(2) - first.rotation * Eigen::Vector3d(0, 0, points[0].z());
  if (!seesAll(h, points)) {
    const RigidTransform rough = byWeakPerspective(points, {bearings.data(), points.size()}, centre);
    if (rough.translation.allFinite() && rough.rotation.coeffs().allFinite()) first = rough;
  }
  result.poses[0] = refine(camera, points, pixels, first);

  // The mirror image: the plane's normal reflected about the line of sight to its centre.
  const RigidTransform& best = result.poses[0].camera_from_body;
  const Eigen::Vector3d centre_in_camera = best * centre;
  const Eigen::Vector3d sight = centre_in_camera.normalized();
  const Eigen::Vector3d normal = best.rotation * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d mirrored = 2.0 * sight * sight.dot(normal) - normal;
  RigidTransform second;
  second.rotation = (Eigen::Quaterniond::FromTwoVectors(normal, mirrored) * best.rotation).normalized();
  second.translation = centre_in_camera - second.rotation * centre;
  result.poses[1] = refine(camera, points, pixels, second);
  result.count = 2;
  if (result.poses[1].rms_px < result.poses[0].rms_px) std::swap(result.poses[0], result.poses[1]);
  return result;
}

}  // namespace helical
