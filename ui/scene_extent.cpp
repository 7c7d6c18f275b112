#include "ui/scene_extent.h"

#include <array>

namespace helical {
namespace {

constexpr double kAirRadius = 1.0, kAirHeight = 1.2;  // m: where helicopters of this kind are

void addCamera(std::vector<Eigen::Vector3d>& points, const CameraModel& model,
               const RigidTransform& camera_from_world) {
  const RigidTransform world_from_camera = camera_from_world.inverse();
  points.push_back(world_from_camera.translation);
  const double w = model.width() - 0.5, h = model.height() - 0.5;
  for (const Eigen::Vector2d& corner :
       std::array<Eigen::Vector2d, 4>{{{-0.5, -0.5}, {w, -0.5}, {w, h}, {-0.5, h}}})
    points.push_back(world_from_camera * Eigen::Vector3d(kFrustumLength * model.bearing(corner).homogeneous()));
}

}  // namespace

std::vector<Eigen::Vector3d> sceneExtent(const SceneSetup& setup, const SceneFrame& frame) {
  std::vector<Eigen::Vector3d> points;
  for (const double x : {-kAirRadius, kAirRadius})
    for (const double y : {-kAirRadius, kAirRadius})
      for (const double z : {0.0, kAirHeight}) points.emplace_back(x, y, frame.floor_height + z);
  for (std::size_t i = 0; i < setup.cameras.size() && i < frame.cameras.size(); ++i) {
    const SceneCameraPose& pose = frame.cameras[i];
    if (pose.known) addCamera(points, setup.cameras[i].model, pose.camera_from_world);
    if (pose.has_truth) addCamera(points, setup.cameras[i].model, pose.true_camera_from_world);
  }
  return points;
}

std::uint32_t knownCameras(const SceneFrame& frame) {
  std::uint32_t known = 0;
  for (std::size_t i = 0; i < frame.cameras.size(); ++i)
    if (frame.cameras[i].known) known |= 1U << i;
  return known;
}

}  // namespace helical
