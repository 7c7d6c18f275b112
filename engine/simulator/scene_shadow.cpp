#include "engine/simulator/scene_shadow.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/rotation.h"
#include "engine/simulator/scene_room.h"

namespace helical {
namespace {

constexpr double kReach = 0.42;  ///< m, half side of the floor square that is looked at

struct Shadow {
  Eigen::Vector2d centre;
  Eigen::Vector2d nose;
  double softness2;

  double at(const Eigen::Vector2d& floor) const {
    const Eigen::Vector2d d = floor - centre;
    const double along = d.dot(nose), across = nose.x() * d.y() - nose.y() * d.x();
    const double rotor = 0.20 * falloff(d.squaredNorm(), 0.15 * 0.15);
    const double body = 0.45 * falloff(along * along * 0.20 + across * across, 0.035 * 0.035);
    return 1.0 - std::min(0.6, rotor + body);
  }

  double falloff(double distance2, double radius2) const {
    const double size2 = radius2 + softness2;
    const double q = distance2 / size2;
    return radius2 / size2 / (1.0 + q * q);
  }
};

struct PixelBox {
  int left, top, right, bottom;
};

/// Of the square around the shadow; empty if a corner is not in front of the camera.
PixelBox boxOf(const CameraModel& model, const RigidTransform& camera_from_world,
               const Eigen::Vector2d& centre) {
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
  for (const double dx : {-kReach, kReach})
    for (const double dy : {-kReach, kReach}) {
      const auto pixel =
          model.project(camera_from_world * Eigen::Vector3d(centre.x() + dx, centre.y() + dy, 0.0));
      if (!pixel) return {0, 0, -1, -1};
      left = std::min(left, pixel->x());
      right = std::max(right, pixel->x());
      top = std::min(top, pixel->y());
      bottom = std::max(bottom, pixel->y());
    }
  const auto inside = [](double value, int size) {
    return static_cast<int>(std::clamp(value, -1.0, double(size)));
  };
  return {std::max(0, inside(left, model.width())), std::max(0, inside(top, model.height())),
          std::min(model.width() - 1, inside(right, model.width())),
          std::min(model.height() - 1, inside(bottom, model.height()))};
}

}  // namespace

void castShadow(const CameraModel& model, const RigidTransform& camera_from_world,
                const RigidTransform& world_from_body, const SceneBackground& background, std::uint8_t* bgr) {
  const Eigen::Vector3d& body = world_from_body.translation;
  const Eigen::Vector3d lamp = lampDirection();
  const double height = std::max(0.0, body.z());
  const double yaw = yawOf(world_from_body.rotation);
  const double softness = 0.01 + 0.10 * height;
  const Shadow shadow{body.head<2>() - lamp.head<2>() / lamp.z() * height,
                      {std::cos(yaw), std::sin(yaw)},
                      softness * softness};
  const PixelBox box = boxOf(model, camera_from_world, shadow.centre);
  if (box.right < box.left || box.bottom < box.top) return;

  // Over this small box the lens is as good as linear.
  const Eigen::Vector2d corner(box.left, box.top);
  const double w = std::max(1, box.right - box.left), h = std::max(1, box.bottom - box.top);
  const Eigen::Vector2d bearing = model.bearing(corner);
  const Eigen::Vector2d bearing_per_x = (model.bearing(corner + Eigen::Vector2d(w, 0)) - bearing) / w;
  const Eigen::Vector2d bearing_per_y = (model.bearing(corner + Eigen::Vector2d(0, h)) - bearing) / h;
  const Eigen::Matrix3d world_from_camera = camera_from_world.rotation.conjugate().toRotationMatrix();
  const Eigen::Vector3d camera = camera_from_world.inverseTranslation();
  const Eigen::Vector3d ray_per_x = world_from_camera.leftCols<2>() * bearing_per_x;
  for (int y = box.top; y <= box.bottom; ++y) {
    const Eigen::Vector2d first = bearing + (y - box.top) * bearing_per_y;
    Eigen::Vector3d ray = world_from_camera * Eigen::Vector3d(first.x(), first.y(), 1.0);
    for (int x = box.left; x <= box.right; ++x, ray += ray_per_x) {
      if (!background.isFloor(x, y) || !(ray.z() < -1e-6)) continue;
      const double light = shadow.at(camera.head<2>() - camera.z() / ray.z() * ray.head<2>());
      const int scale = static_cast<int>(light * 256.0);
      std::uint8_t* pixel = bgr + 3 * (static_cast<std::ptrdiff_t>(y) * model.width() + x);
      for (int c = 0; c < 3; ++c) pixel[c] = static_cast<std::uint8_t>(pixel[c] * scale >> 8);
    }
  }
}

}  // namespace helical
