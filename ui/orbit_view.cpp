#include "ui/orbit_view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "engine/geometry/rotation.h"

namespace helical {
namespace {

constexpr double kHighest = 0.5 * kPi;
constexpr double kLowest = -0.1;
constexpr double kNearest = 0.4;
constexpr double kFarthest = 60.0;

}  // namespace

OrbitView::OrbitView(double reach) : reach_(std::max(1.5, reach)) {
  look(SceneViewpoint::kFollow);
}

void OrbitView::look(SceneViewpoint viewpoint) {
  viewpoint_ = viewpoint;
  offset_.setZero();
  const double half = std::tan(0.5 * kFieldOfView);
  switch (viewpoint) {
    case SceneViewpoint::kFollow:
      azimuth_ = toRadians(-65);
      elevation_ = toRadians(20);
      distance_ = 2.3;
      break;
    case SceneViewpoint::kTop:
      azimuth_ = toRadians(-90);
      elevation_ = kHighest;
      distance_ = reach_ + 1.1 * reach_ / half;  // the cameras are about as high as they are far
      focus_.setZero();
      break;
    case SceneViewpoint::kIso:
      azimuth_ = toRadians(-105);
      elevation_ = toRadians(20);
      distance_ = 0.8 * reach_ / half;
      focus_ = Eigen::Vector3d(0.0, 0.0, 0.9);
      break;
  }
}

void OrbitView::turn(double azimuth, double elevation) {
  azimuth_ = wrapAngle(azimuth_ + azimuth);
  elevation_ = std::clamp(elevation_ + elevation, kLowest, kHighest);
}

void OrbitView::zoom(double factor) {
  distance_ = std::clamp(distance_ * factor, kNearest, kFarthest);
}

void OrbitView::pan(double right, double up) {
  const Eigen::Vector3d forward = (focus_ - eye()).normalized();
  const Eigen::Vector3d side = forward.cross(this->up()).normalized();
  const double height = 2.0 * distance_ * std::tan(0.5 * kFieldOfView);
  const Eigen::Vector3d shift = height * (right * side + up * side.cross(forward));
  offset_ += shift;
  focus_ += shift;
}

void OrbitView::track(const Eigen::Vector3d& helicopter) {
  if (viewpoint_ == SceneViewpoint::kFollow) focus_ = helicopter + offset_;
}

Eigen::Vector3d OrbitView::eye() const {
  return focus_ + distance_ * Eigen::Vector3d(std::cos(elevation_) * std::cos(azimuth_),
                                              std::cos(elevation_) * std::sin(azimuth_),
                                              std::sin(elevation_));
}

Eigen::Vector3d OrbitView::up() const {
  // Straight above, "up" on the screen is away from the eye's azimuth, which is also right everywhere else.
  return {-std::sin(elevation_) * std::cos(azimuth_), -std::sin(elevation_) * std::sin(azimuth_),
          std::cos(elevation_)};
}

}  // namespace helical
