#include "engine/calibration/pose_modes.h"

#include <Eigen/Eigenvalues>

#include "engine/calibration/camera_perturbation.h"

namespace helical {
namespace {

constexpr double kClearlyBetter = 2.0;     // squared sigmas
constexpr double kSameRotationRad = 0.01;  // two solutions closer than both are one mode
constexpr double kSamePositionM = 0.03;
constexpr ResectionOptions kSolve{.iterations = 30};

struct MarkerPlane {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal;
};

MarkerPlane planeOf(const MarkerLayout& markers) {
  MarkerPlane plane;
  for (const auto& marker : markers.all()) plane.centre += marker / markers.count();
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const auto& marker : markers.all())
    scatter += (marker - plane.centre) * (marker - plane.centre).transpose();
  plane.normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors().col(0);
  return plane;
}

bool sameMode(const RigidTransform& a, const RigidTransform& b) {
  const Vector6d change = perturbationBetween(a, b);
  return change.head<3>().norm() < kSameRotationRad && change.tail<3>().norm() < kSamePositionM;
}

}  // namespace

RigidTransform mirroredPose(const RigidTransform& camera_from_world, const RigidTransform& world_from_body,
                            const MarkerLayout& markers) {
  const MarkerPlane plane = planeOf(markers);
  const RigidTransform camera_from_body = camera_from_world * world_from_body;
  const Eigen::Vector3d centre = camera_from_body * plane.centre;
  const Eigen::Vector3d sight = centre.normalized();
  const Eigen::Vector3d normal = camera_from_body.rotation * plane.normal;
  Eigen::Vector3d mirrored = 2.0 * sight * sight.dot(normal) - normal;
  if (mirrored.dot(sight) * normal.dot(sight) < 0.0) mirrored = -mirrored;
  RigidTransform other;
  other.rotation =
      (Eigen::Quaterniond::FromTwoVectors(normal, mirrored) * camera_from_body.rotation).normalized();
  other.translation = centre - other.rotation * plane.centre;
  return other * world_from_body.inverse();
}

ModeChoice chooseMode(const CameraModel& camera, const MarkerLayout& markers,
                      std::span<const StoredFrame* const> frames, const RigidTransform& current,
                      const RigidTransform& guess) {
  ModeChoice choice;
  choice.best = resect(camera, markers, frames, current, kSolve);
  if (frames.empty()) return choice;
  const RigidTransform kept = choice.best.camera_from_world;
  const RigidTransform mirrored = mirroredPose(kept, frames.back()->world_from_body, markers);
  for (const RigidTransform& start : {mirrored, guess}) {
    const Resection other = resect(camera, markers, frames, start, kSolve);
    if (!other.ok || (choice.best.ok && other.cost > choice.best.cost - kClearlyBetter)) continue;
    choice.best = other;
    choice.other_mode = !sameMode(kept, other.camera_from_world);
  }
  return choice;
}

bool ModeSchedule::due() {
  if (++seen_ < next_) return false;
  next_ += next_ / 2;
  return true;
}

}  // namespace helical
