#include "engine/simulator/disturbances.h"

#include <algorithm>

#include "engine/geometry/camera_perturbation.h"

namespace helical {
namespace {

constexpr double kSlideTime = 0.25;  // s

Eigen::Vector3d randomDirection(Random& random) {
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return Eigen::Vector3d(x, y, z).normalized();
}

RigidTransform moved(const RigidTransform& camera_from_world, double angle, double distance, bool across,
                     Random& random) {
  Eigen::Vector3d axis = randomDirection(random);
  if (across) axis = Eigen::Vector3d(axis.x(), axis.y(), 0.0).normalized();
  Vector6d perturbation;
  perturbation.head<3>() = angle * axis;
  perturbation.tail<3>() = distance * randomDirection(random);
  return perturbCamera(camera_from_world, perturbation);
}

}  // namespace

RigidTransform displaced(const RigidTransform& camera_from_world, double angle, double distance,
                         Random random) {
  return moved(camera_from_world, angle, distance, false, random);
}

CameraDisturbances::CameraDisturbances(CameraId camera, const SimulationOptions& options,
                                       const RigidTransform& camera_from_world, Random random)
    : initial_(camera_from_world) {
  for (const auto& occlusion : options.occlusions)
    if (occlusion.camera == camera) occlusions_.push_back(occlusion);
  std::vector<Bump> bumps;
  for (const auto& bump : options.bumps)
    if (bump.camera == camera) bumps.push_back(bump);
  std::sort(bumps.begin(), bumps.end(), [](const Bump& a, const Bump& b) { return a.at_s < b.at_s; });
  RigidTransform pose = camera_from_world;
  for (const auto& bump : bumps) {
    pose = moved(pose, bump.angle, bump.distance, bump.across, random);
    knocks_.push_back({bump.at_s, pose});
  }
}

double CameraDisturbances::boardCover(double time_s) const {
  double cover = 0.0;
  for (const auto& o : occlusions_) {
    const double slid_in = (time_s - o.from_s) / kSlideTime, slid_out = (o.to_s - time_s) / kSlideTime;
    cover = std::max(cover, std::clamp(std::min(slid_in, slid_out + 1.0), 0.0, 1.0));
  }
  return cover;
}

RigidTransform CameraDisturbances::cameraFromWorld(double time_s) const {
  RigidTransform pose = initial_;
  for (const auto& knock : knocks_)
    if (time_s >= knock.at_s) pose = knock.camera_from_world;
  return pose;
}

}  // namespace helical
