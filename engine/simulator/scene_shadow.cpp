#include "engine/simulator/scene_shadow.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/rotation.h"
#include "engine/simulator/scene_room.h"

namespace helical {
namespace {

constexpr double kRotorReach = 0.25;  ///< m, where the rotor's shadow ends under a helicopter on the ground
constexpr double kBodyReach = 0.075;  ///< across; along it is longer
constexpr double kBodySlimness2 = 0.16;

/// Of a helicopter at some height: faint, large and soft for the rotor, darker and longish for the body. Each
/// is (1 - d^2)^2 within its reach; together they take the same amount of light at any height.
struct Shadow {
  Shadow(const Eigen::Vector2d& at, double yaw, double height)
      : centre(at), nose(std::cos(yaw), std::sin(yaw)), rotor_reach(kRotorReach + 0.08 * height) {
    const double body_reach = kBodyReach + 0.10 * height;
    rotor_scale = 1.0 / (rotor_reach * rotor_reach);
    body_scale = 1.0 / (body_reach * body_reach);
    rotor_strength = 0.28 * kRotorReach * kRotorReach * rotor_scale;
    body_strength = 0.50 * kBodyReach / body_reach;
  }

  double lightAt(double x, double y) const {
    const double dx = x - centre.x(), dy = y - centre.y();
    const double rotor = 1.0 - (dx * dx + dy * dy) * rotor_scale;
    if (rotor <= 0.0) return 1.0;
    const double along = dx * nose.x() + dy * nose.y(), across = nose.x() * dy - nose.y() * dx;
    const double body = std::max(0.0, 1.0 - (along * along * kBodySlimness2 + across * across) * body_scale);
    return 1.0 - rotor_strength * rotor * rotor - body_strength * body * body;
  }

  Eigen::Vector2d centre;
  Eigen::Vector2d nose;
  double rotor_reach;
  double rotor_scale = 0.0;
  double body_scale = 0.0;
  double rotor_strength = 0.0;
  double body_strength = 0.0;
};

struct PixelBox {
  int left, top, right, bottom;
};

/// Of the square around the shadow; empty if a corner is not in front of the camera.
PixelBox boxOf(const CameraModel& model, const RigidTransform& camera_from_world, const Shadow& shadow) {
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
  for (const double dx : {-shadow.rotor_reach, shadow.rotor_reach})
    for (const double dy : {-shadow.rotor_reach, shadow.rotor_reach}) {
      const auto pixel = model.project(camera_from_world *
                                       Eigen::Vector3d(shadow.centre.x() + dx, shadow.centre.y() + dy, 0.0));
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
  const Shadow shadow(body.head<2>() - lamp.head<2>() / lamp.z() * height, yawOf(world_from_body.rotation),
                      height);
  const PixelBox box = boxOf(model, camera_from_world, shadow);
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
      const double t = -camera.z() / ray.z();
      const int scale =
          static_cast<int>(shadow.lightAt(camera.x() + t * ray.x(), camera.y() + t * ray.y()) * 256.0);
      if (scale == 256) continue;
      std::uint8_t* pixel = bgr + 3 * (static_cast<std::ptrdiff_t>(y) * model.width() + x);
      for (int c = 0; c < 3; ++c) pixel[c] = static_cast<std::uint8_t>(pixel[c] * scale >> 8);
    }
  }
}

}  // namespace helical
