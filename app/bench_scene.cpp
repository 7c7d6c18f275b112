#include "app/bench_scene.h"

#include <cmath>

#include "engine/geometry/rotation.h"
#include "engine/simulator/scene_renderer.h"

namespace helical {
namespace {

constexpr double kPaperFocalLength = 567.6;  ///< px, of the default rig at 640 pixels
constexpr double kPaperWidth = 640.0;

/// 2.4 m from a point above the pad, which it looks at from 40 degrees above the horizon.
RigidTransform cameraFromWorld() {
  const double elevation = toRadians(40.0), distance = 2.4;
  RigidTransform pose;
  Eigen::Matrix3d axes;                                 // rows: x right, y down, z forward
  axes << 0.0, -1.0, 0.0,                               //
      -std::sin(elevation), 0.0, -std::cos(elevation),  //
      std::cos(elevation), 0.0, -std::sin(elevation);
  pose.rotation = Eigen::Quaterniond(axes);
  const Eigen::Vector3d centre = Eigen::Vector3d(0.0, 0.0, 0.5) - distance * axes.row(2).transpose();
  pose.translation = -(pose.rotation * centre);
  return pose;
}

cv::Mat copyOf(const ImageView& view) {
  return cv::Mat(view.height, view.width, CV_8UC3, const_cast<std::uint8_t*>(view.data),
                 static_cast<std::size_t>(view.stride))
      .clone();
}

}  // namespace

BenchScene renderBenchScene(int width, int height) {
  const double focal_length = kPaperFocalLength * width / kPaperWidth;
  const CameraModel model(width, height, focal_length, focal_length, 0.5 * (width - 1), 0.5 * (height - 1));
  SceneRenderer renderer(model, MarkerLayout::paper(), SceneOptions{});
  HelicopterView helicopter;
  helicopter.world_from_body.translation = {0.05, -0.03, 0.5};
  BenchScene scene;
  scene.background = copyOf(renderer.render(cameraFromWorld(), std::nullopt, 0.0));
  scene.frame = copyOf(renderer.render(cameraFromWorld(), helicopter, 0.02));
  return scene;
}

}  // namespace helical
