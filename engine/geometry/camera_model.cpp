#include "engine/geometry/camera_model.h"

#include <Eigen/LU>
#include <algorithm>

namespace helical {
namespace {

constexpr double kNearestDepth = 0.05;

/// Squared radius at which d(distorted radius)/d(radius) vanishes, or a large number.
double monotonicRadius2(const std::array<double, 8>& d) {
  for (double r2 = 0.0; r2 < 9.0; r2 += 0.01) {
    const double numerator = 1.0 + r2 * (d[0] + r2 * (d[1] + r2 * d[4]));
    const double denominator = 1.0 + r2 * (d[5] + r2 * (d[6] + r2 * d[7]));
    if (denominator <= 0.05) return r2;
    const double slope = 1.0 + r2 * (3.0 * d[0] + r2 * (5.0 * d[1] + r2 * 7.0 * d[4]));
    const double denominator_slope = 2.0 * r2 * (d[5] + r2 * (2.0 * d[6] + r2 * 3.0 * d[7]));
    if (slope - numerator * denominator_slope / denominator <= 0.05 * denominator) return r2;
  }
  return 1e9;
}

}  // namespace

CameraModel CameraModel::withFocalScale(double scale) const {
  CameraModel scaled = *this;
  scaled.fx_ *= scale;
  scaled.fy_ *= scale;
  return scaled;
}

CameraModel::CameraModel(int width, int height, double fx, double fy, double cx, double cy,
                         const std::array<double, 8>& distortion)
    : width_(width), height_(height), fx_(fx), fy_(fy), cx_(cx), cy_(cy), distortion_(distortion) {
  has_distortion_ = std::any_of(distortion.begin(), distortion.end(), [](double k) { return k != 0.0; });
  rational_ = std::any_of(distortion.begin() + 5, distortion.end(), [](double k) { return k != 0.0; });
  if (has_distortion_) max_radius2_ = monotonicRadius2(distortion);
}

Eigen::Vector2d CameraModel::distort(const Eigen::Vector2d& b, Eigen::Matrix2d* jacobian) const {
  const auto& [k1, k2, p1, p2, k3, k4, k5, k6] = distortion_;
  const double x = b.x(), y = b.y();
  const double r2 = x * x + y * y;
  double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double denominator = rational_ ? 1.0 + r2 * (k4 + r2 * (k5 + r2 * k6)) : 1.0;
  if (rational_) radial /= denominator;
  if (jacobian != nullptr) {
    double slope = 2.0 * (k1 + r2 * (2.0 * k2 + r2 * 3.0 * k3));  // d radial / d x = slope x
    if (rational_)
      slope = (slope - radial * 2.0 * (k4 + r2 * (2.0 * k5 + r2 * 3.0 * k6))) / denominator;
    (*jacobian)(0, 0) = radial + x * x * slope + 2.0 * p1 * y + 6.0 * p2 * x;
    (*jacobian)(0, 1) = x * y * slope + 2.0 * p1 * x + 2.0 * p2 * y;
    (*jacobian)(1, 0) = (*jacobian)(0, 1);
    (*jacobian)(1, 1) = radial + y * y * slope + 6.0 * p1 * y + 2.0 * p2 * x;
  }
  return {x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
          y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
}

std::optional<Eigen::Vector2d> CameraModel::project(const Eigen::Vector3d& point,
                                                    Eigen::Matrix<double, 2, 3>* d_pixel_d_point) const {
  if (!(point.z() > kNearestDepth)) return std::nullopt;
  const double inverse_depth = 1.0 / point.z();
  const Eigen::Vector2d b(point.x() * inverse_depth, point.y() * inverse_depth);
  if (b.squaredNorm() > max_radius2_) return std::nullopt;
  Eigen::Matrix2d jacobian = Eigen::Matrix2d::Identity();
  const Eigen::Vector2d d =
      has_distortion_ ? distort(b, d_pixel_d_point != nullptr ? &jacobian : nullptr) : b;
  if (d_pixel_d_point != nullptr) {
    Eigen::Matrix<double, 2, 3> d_bearing;
    d_bearing << inverse_depth, 0.0, -b.x() * inverse_depth, 0.0, inverse_depth, -b.y() * inverse_depth;
    *d_pixel_d_point = Eigen::DiagonalMatrix<double, 2>(fx_, fy_) * jacobian * d_bearing;
  }
  return Eigen::Vector2d(fx_ * d.x() + cx_, fy_ * d.y() + cy_);
}

Eigen::Vector2d CameraModel::bearing(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d target((pixel.x() - cx_) / fx_, (pixel.y() - cy_) / fy_);
  if (!has_distortion_) return target;
  Eigen::Vector2d b = target;
  for (int i = 0; i < 20; ++i) {
    Eigen::Matrix2d jacobian;
    const Eigen::Vector2d step = Eigen::Vector2d(distort(b, &jacobian) - target);
    const Eigen::Vector2d change = jacobian.inverse() * step;
    b -= change;
    if (change.squaredNorm() < 1e-24) break;
  }
  return b;
}

bool CameraModel::contains(const Eigen::Vector2d& pixel, double margin) const {
  return pixel.x() >= margin - 0.5 && pixel.y() >= margin - 0.5 && pixel.x() <= width_ - 0.5 - margin &&
         pixel.y() <= height_ - 0.5 - margin;
}

}  // namespace helical
