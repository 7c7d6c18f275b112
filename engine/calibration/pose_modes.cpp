#include "engine/calibration/pose_modes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "engine/calibration/camera_perturbation.h"
#include "engine/geometry/camera_perturbation.h"
#include "engine/geometry/planar_pnp.h"

namespace helical {
namespace {

// Squared sigmas. A solution for these frames alone beats the true pose by 6 on average: it has six
// parameters.
constexpr double kBetter = 2.0;   // between two solutions
constexpr double kLost = 40.0;    // between a solution and the pose that is in use
constexpr double kPoorFit = 4.0;  // squared sigmas per ball, where 2 are expected
constexpr double kFlatM = 1e-6;
constexpr double kSameRotationRad = 0.01;  // two solutions closer than both are one mode
constexpr double kSamePositionM = 0.03;
constexpr MarginalResectionOptions kSolve{.iterations = 30};

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
  const Vector6d change = cameraPerturbation(a, b);
  return change.head<3>().norm() < kSameRotationRad && change.tail<3>().norm() < kSamePositionM;
}

/// Poses that need no guess, from the newest frame with enough of a flat layout's balls.
struct Starts {
  std::array<RigidTransform, 2> poses;
  int count = 0;
};

Starts planarStarts(const CameraModel& camera, const MarkerLayout& markers,
                    std::span<const StoredFrame* const> frames) {
  const auto all = markers.all();
  const bool flat = std::all_of(all.begin(), all.end(), [&](const Eigen::Vector3d& marker) {
    return std::abs(marker.z() - all.front().z()) < kFlatM;
  });
  Starts starts;
  const auto newest = std::find_if(frames.rbegin(), frames.rend(),
                                   [](const StoredFrame* frame) { return frame->count >= 4; });
  if (!flat || newest == frames.rend()) return starts;
  const StoredFrame& frame = **newest;
  std::array<Eigen::Vector3d, kMaxMarkers> points;
  std::array<Eigen::Vector2d, kMaxMarkers> pixels;
  for (std::size_t i = 0; i < static_cast<std::size_t>(frame.count); ++i) {
    points[i] = markers.inBody(frame.pixels[i].marker);
    pixels[i] = frame.pixels[i].pixel;
  }
  const auto count = static_cast<std::size_t>(frame.count);
  const PlanarPoses solutions = solvePlanarPnp(camera, {points.data(), count}, {pixels.data(), count});
  const RigidTransform body_from_world = frame.world_from_body.inverse();
  for (; starts.count < solutions.count; ++starts.count) {
    const auto i = static_cast<std::size_t>(starts.count);
    starts.poses[i] = solutions.poses[i].camera_from_body * body_from_world;
  }
  return starts;
}

/// Solves from another start and keeps the result if it is better.
void consider(const CameraModel& camera, const MarkerLayout& markers,
              std::span<const StoredFrame* const> frames, const RigidTransform& start,
              MarginalResection& best) {
  const MarginalResection other = resect(camera, markers, frames, start, kSolve);
  if (other.ok && (!best.ok || other.cost < best.cost - kBetter)) best = other;
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
  const RigidTransform refined = choice.best.camera_from_world;
  consider(camera, markers, frames, mirroredPose(refined, frames.back()->world_from_body, markers),
           choice.best);
  consider(camera, markers, frames, guess, choice.best);
  if (!choice.best.ok || choice.best.cost > kPoorFit * choice.best.terms) {
    const Starts starts = planarStarts(camera, markers, frames);
    for (int i = 0; i < starts.count; ++i)
      consider(camera, markers, frames, starts.poses[static_cast<std::size_t>(i)], choice.best);
  }
  const double cost_in_use = resect(camera, markers, frames, current, {.iterations = 0}).cost;
  choice.other_mode = choice.best.ok && (!sameMode(refined, choice.best.camera_from_world) ||
                                         choice.best.cost < cost_in_use - kLost);
  return choice;
}

bool ModeSchedule::due() {
  if (++seen_ < next_) return false;
  next_ += next_ / 2;
  return true;
}

}  // namespace helical
