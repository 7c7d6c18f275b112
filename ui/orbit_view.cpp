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
constexpr double kUsualReach = 1.5;  // m
constexpr double kMargin = 1.12;     // for the cameras' names
constexpr int kFittingSteps = 4;

}  // namespace

OrbitView::OrbitView() {
  for (const double x : {-kUsualReach, kUsualReach})
    for (const double y : {-kUsualReach, kUsualReach}) field_.emplace_back(x, y, 0.0);
  look(SceneViewpoint::kFollow);
}

void OrbitView::setField(const std::vector<Eigen::Vector3d>& points, double aspect) {
  field_ = points;
  aspect_ = aspect;
  if (!by_hand_ && viewpoint_ != SceneViewpoint::kFollow) fit();
}

void OrbitView::look(SceneViewpoint viewpoint) {
  viewpoint_ = viewpoint;
  by_hand_ = false;
  offset_.setZero();
  switch (viewpoint) {
    case SceneViewpoint::kFollow:
      azimuth_ = toRadians(-65);
      elevation_ = toRadians(20);
      distance_ = 2.3;
      break;
    case SceneViewpoint::kTop:
      azimuth_ = toRadians(-90);
      elevation_ = kHighest;
      fit();
      break;
    case SceneViewpoint::kIso:
      azimuth_ = toRadians(-105);
      elevation_ = toRadians(20);
      fit();
      break;
  }
}

double OrbitView::fittingDistance() const {
  const Eigen::Vector3d back = (eye() - focus_).normalized(), top = up(), right = top.cross(back);
  const double half = std::tan(0.5 * kFieldOfView) / kMargin;
  double distance = kNearest;
  for (const Eigen::Vector3d& point : field_) {
    const Eigen::Vector3d from_focus = point - focus_;
    const double aside = std::max(std::abs(right.dot(from_focus)) / aspect_, std::abs(top.dot(from_focus)));
    distance = std::max(distance, back.dot(from_focus) + aside / half);
  }
  return std::min(distance, kFarthest);
}

void OrbitView::fit() {
  if (field_.empty()) return;
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : field_) box.extend(point);
  focus_ = box.center();
  // What is nearer to the eye takes more room: the middle of the picture is not that of the field.
  for (int i = 0; i < kFittingSteps; ++i) {
    distance_ = fittingDistance();
    const Eigen::Vector3d from = eye(), back = (from - focus_).normalized(), top = up(), right = top.cross(back);
    Eigen::AlignedBox2d seen;
    for (const Eigen::Vector3d& point : field_) {
      const double depth = std::max(kNearest, back.dot(from - point));
      seen.extend(Eigen::Vector2d(right.dot(point - from), top.dot(point - from)) / depth);
    }
    const Eigen::Vector2d middle = seen.center();
    focus_ += distance_ * (middle.x() * right + middle.y() * top);
  }
  distance_ = fittingDistance();
}

void OrbitView::turn(double azimuth, double elevation) {
  by_hand_ = true;
  azimuth_ = wrapAngle(azimuth_ + azimuth);
  elevation_ = std::clamp(elevation_ + elevation, kLowest, kHighest);
}

void OrbitView::zoom(double factor) {
  by_hand_ = true;
  distance_ = std::clamp(distance_ * factor, kNearest, kFarthest);
}

void OrbitView::pan(double right, double up) {
  const Eigen::Vector3d forward = (focus_ - eye()).normalized();
  const Eigen::Vector3d side = forward.cross(this->up()).normalized();
  const double height = 2.0 * distance_ * std::tan(0.5 * kFieldOfView);
  const Eigen::Vector3d shift = height * (right * side + up * side.cross(forward));
  by_hand_ = true;
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
