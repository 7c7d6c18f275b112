#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

namespace helical {

/// Pinhole with Brown-Conrady distortion k1 k2 p1 p2 k3 (Brown 1971), or the rational model with k4 k5 k6
/// behind them for strongly distorting lenses: radial factor (1 + k1 r^2 + k2 r^4 + k3 r^6) /
/// (1 + k4 r^2 + k5 r^4 + k6 r^6) (Claus and Fitzgibbon 2005). The order is OpenCV's.
/// Camera frame: x right, y down, z forward. Pixel (0, 0) is the centre of the first pixel.
class CameraModel {
 public:
  CameraModel() = default;
  CameraModel(int width, int height, double fx, double fy, double cx, double cy,
              const std::array<double, 8>& distortion = {});

  int width() const { return width_; }
  int height() const { return height_; }
  double fx() const { return fx_; }
  double fy() const { return fy_; }
  double cx() const { return cx_; }
  double cy() const { return cy_; }
  const std::array<double, 8>& distortion() const { return distortion_; }
  /// Whether k4 k5 k6 are in use; without them the model has the first five coefficients alone.
  bool rational() const { return rational_; }

  /// The same with both focal lengths multiplied.
  CameraModel withFocalScale(double scale) const;

  /// Pixel of a point in the camera frame [m]; nothing for a point nearer than 5 cm or behind the camera, or
  /// so far outside the image that the distortion polynomial folds back. `d_pixel_d_point` is the 2x3
  /// Jacobian.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& point_in_camera,
                                         Eigen::Matrix<double, 2, 3>* d_pixel_d_point = nullptr) const;

  /// Bearing (x/z, y/z) of a pixel, distortion removed by Newton's method.
  Eigen::Vector2d bearing(const Eigen::Vector2d& pixel) const;

  /// Whether a pixel lies in the image, at least `margin` pixels inside its edge.
  bool contains(const Eigen::Vector2d& pixel, double margin = 0.0) const;

 private:
  Eigen::Vector2d distort(const Eigen::Vector2d& bearing, Eigen::Matrix2d* jacobian) const;

  int width_ = 0;
  int height_ = 0;
  double fx_ = 1.0;
  double fy_ = 1.0;
  double cx_ = 0.0;
  double cy_ = 0.0;
  std::array<double, 8> distortion_{};
  bool has_distortion_ = false;
  bool rational_ = false;
  double max_radius2_ = 1e9;  ///< squared bearing up to which the distorted radius is monotonic
};

}  // namespace helical
