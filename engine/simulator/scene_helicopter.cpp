#include "engine/simulator/scene_helicopter.h"

#include <algorithm>
#include <cmath>

#include "engine/simulator/scene_room.h"

namespace helical {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr int kStripRows = 8;
constexpr double kRotorRadius = 0.17;
constexpr double kUpperRotorHeight = 0.165;
constexpr double kLowerRotorHeight = 0.103;

const Surface kWhite{{208, 210, 212}, Finish::kFuselage};
const Surface kBallGreen{{50, 192, 54}, Finish::kBall};
const Surface kBlack{{46, 44, 44}, Finish::kPlain};
const Surface kCarbon{{74, 72, 72}, Finish::kPlain};
const Surface kSilver{{168, 166, 164}, Finish::kPlain};
const Surface kOrange{{58, 84, 186}, Finish::kPlain};
const Surface kUpperBlur{{92, 90, 90}, Finish::kPlain};
const Surface kLowerBlur{{70, 68, 68}, Finish::kPlain};

}  // namespace

SceneHelicopter::SceneHelicopter(const CameraModel& model, const MarkerLayout& markers_in_body)
    : model_(model), markers_(markers_in_body), strip_(model.width(), kStripRows) {
  ellipsoids_.reserve(8 + kMaxMarkers);
  rods_.reserve(24 + kMaxMarkers);
  rotors_.reserve(2);
}

void SceneHelicopter::draw(const RigidTransform& camera_from_world, const HelicopterView& view, double gain,
                           SceneNoise& noise, std::uint8_t* bgr) {
  build(camera_from_world * view.world_from_body, view);
  const Vector3d light = camera_from_world.rotation * lampDirection();
  for (int top = rect_.top; top <= rect_.bottom; top += kStripRows) {
    drawStrip({rect_.left, top, rect_.right, std::min(rect_.bottom, top + kStripRows - 1)}, light);
    resolve(gain, noise, bgr);
  }
}

void SceneHelicopter::build(const RigidTransform& camera_from_body, const HelicopterView& view) {
  camera_from_body_ = camera_from_body;
  body_axes_ = camera_from_body.rotation.toRotationMatrix();
  rect_ = {};
  ellipsoids_.clear();
  rods_.clear();
  rotors_.clear();
  addBody();
  addMarkers();
  addRotors(view);
}

void SceneHelicopter::addBody() {
  addEllipsoid({0.020, 0, 0.002}, {0.088, 0.031, 0.036}, kWhite);
  addEllipsoid({-0.055, 0, 0.006}, {0.050, 0.016, 0.015}, kCarbon);
  addRod({-0.06, 0, 0.008}, {-0.225, 0, 0.024}, 0.0045, kCarbon);
  addRod({-0.215, 0, -0.005}, {-0.232, 0, 0.066}, 0.0065, kOrange);
  addRod({-0.190, -0.045, 0.021}, {-0.190, 0.045, 0.021}, 0.0045, kOrange);
  addRod({0, 0, 0.03}, {0, 0, 0.178}, 0.0016, kSilver);
  addEllipsoid({0, 0, kLowerRotorHeight}, {0.006, 0.006, 0.004}, kBlack);
  addEllipsoid({0, 0, kUpperRotorHeight}, {0.005, 0.005, 0.004}, kBlack);
  for (const double side : {-1.0, 1.0}) {
    addRod({-0.075, 0.048 * side, -0.057}, {0.085, 0.048 * side, -0.057}, 0.003, kBlack);
    addRod({0.085, 0.048 * side, -0.057}, {0.103, 0.048 * side, -0.047}, 0.003, kBlack);
    for (const double x : {-0.04, 0.05})
      addRod({x, 0.02 * side, -0.025}, {x, 0.048 * side, -0.057}, 0.0025, kBlack);
  }
}

void SceneHelicopter::addMarkers() {
  for (const Vector3d& marker : markers_.all()) {
    // The rod holds the ball from below, where it hides nothing of it from the cameras above.
    const Vector3d foot = marker - Vector3d(0, 0, 0.85 * markers_.radius());
    addRod({0.1 * marker.x(), 0.1 * marker.y(), -0.03}, foot, 0.0018, kSilver);
    addEllipsoid(marker, Vector3d::Constant(markers_.radius()), kBallGreen);
  }
}

void SceneHelicopter::addRotors(const HelicopterView& view) {
  const auto add = [this](double height, double angle, const Surface& surface) {
    const auto rotor =
        RotorShape::make(model_, camera_from_body_ * Vector3d(0, 0, height), body_axes_.col(2),
                         body_axes_ * Vector3d(std::cos(angle), std::sin(angle), 0), kRotorRadius, surface);
    if (!rotor) return;
    rotors_.push_back(*rotor);
    rect_.include(rotor->rect());
  };
  const bool seen_from_above = camera_from_body_.inverseTranslation().z() > kUpperRotorHeight;
  if (!seen_from_above) add(kUpperRotorHeight, view.upper_rotor_angle, kUpperBlur);
  add(kLowerRotorHeight, view.lower_rotor_angle, kLowerBlur);
  if (seen_from_above) add(kUpperRotorHeight, view.upper_rotor_angle, kUpperBlur);
}

void SceneHelicopter::addEllipsoid(const Vector3d& centre, const Vector3d& radii, const Surface& surface) {
  const auto shape = EllipsoidShape::make(model_, camera_from_body_ * centre, body_axes_, radii, surface);
  if (!shape) return;
  ellipsoids_.push_back(*shape);
  rect_.include(shape->rect());
}

void SceneHelicopter::addRod(const Vector3d& from, const Vector3d& to, double radius,
                             const Surface& surface) {
  const auto shape =
      RodShape::make(model_, camera_from_body_ * from, camera_from_body_ * to, radius, surface);
  if (!shape) return;
  rods_.push_back(*shape);
  rect_.include(shape->rect());
}

void SceneHelicopter::drawStrip(const PixelRect& area, const Vector3d& light) {
  strip_.start(area);
  for (const auto& ellipsoid : ellipsoids_) ellipsoid.draw(strip_, light);
  for (const auto& rod : rods_) rod.draw(strip_, light);
  for (const auto& rotor : rotors_) rotor.draw(strip_);
}

void SceneHelicopter::resolve(double gain, SceneNoise& noise, std::uint8_t* bgr) {
  constexpr int kPerAxis = SampleStrip::kPerAxis;
  constexpr float kShare = 1.0F / (kPerAxis * kPerAxis);
  const PixelRect& area = strip_.area();
  for (int y = area.top; y <= area.bottom; ++y) {
    const std::int16_t* deviates = noise.stretch(3 * (area.right - area.left + 1));
    std::uint8_t* pixel = bgr + 3 * (static_cast<std::ptrdiff_t>(y) * model_.width() + area.left);
    for (int x = 0; x <= area.right - area.left; ++x, pixel += 3, deviates += 3) {
      Eigen::Vector4f sum = Eigen::Vector4f::Zero();
      for (int sy = 0; sy < kPerAxis; ++sy) {
        const Eigen::Vector4f* colours = strip_.colours(y, sy) + x * kPerAxis;
        for (int sx = 0; sx < kPerAxis; ++sx) sum += colours[sx];
      }
      const float opacity = sum[3] * kShare;
      if (opacity <= 0.0F) continue;
      for (int c = 0; c < 3; ++c) {
        const float drawn = sum[c] * kShare * static_cast<float>(gain) +
                            opacity * static_cast<float>(deviates[c]) / SceneNoise::kUnitsPerLevel;
        pixel[c] =
            static_cast<std::uint8_t>(std::clamp(pixel[c] * (1.0F - opacity) + drawn + 0.5F, 0.0F, 255.0F));
      }
    }
  }
}

}  // namespace helical
