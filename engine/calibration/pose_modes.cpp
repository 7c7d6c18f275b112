#include "engine/calibration/pose_modes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/check.h"
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

/// Poses that need no guess, from the newest frame with enough of a flat layout's balls: returns how many.
int planarStarts(const CameraModel& camera, const MarkerLayout& markers,
                 std::span<const StoredFrame* const> frames, std::array<RigidTransform, 2>& starts) {
  const auto all = markers.all();
  const bool flat = std::all_of(all.begin(), all.end(), [&](const Eigen::Vector3d& marker) {
    return std::abs(marker.z() - all.front().z()) < kFlatM;
  });
  const auto newest = std::find_if(frames.rbegin(), frames.rend(),
                                   [](const StoredFrame* frame) { return frame->count >= 4; });
  if (!flat || newest == frames.rend()) return 0;
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
  for (std::size_t i = 0; i < static_cast<std::size_t>(solutions.count); ++i)
    starts[i] = solutions.poses[i].camera_from_body * body_from_world;
  return solutions.count;
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

void ModeSearch::start(std::span<const StoredFrame* const> frames, const RigidTransform& in_use,
                       const RigidTransform& guess) {
  HELICAL_CHECK(!frames.empty() && frames.size() <= kModeFrames);
  count_ = frames.size();
  for (std::size_t i = 0; i < count_; ++i) {
    frames_[i] = *frames[i];
    order_[i] = &frames_[i];
  }
  first_ = in_use;
  guess_ = guess;
  choice_ = {};
  stage_ = Stage::kInUse;
  run_.start({order_.data(), count_}, first_, kSolve);
}

void ModeSearch::advance(const RigidTransform& in_use, int& budget) {
  while (running()) {
    run_.advance(camera_, markers_, budget);
    if (run_.running()) return;
    take(run_.result());
    if (running())
      run_.start({order_.data(), count_}, startPose(in_use),
                 stage_ == Stage::kCompare ? MarginalResectionOptions{.iterations = 0} : kSolve);
  }
}

RigidTransform ModeSearch::startPose(const RigidTransform& in_use) const {
  switch (stage_) {
    case Stage::kMirrored:
      return mirroredPose(refined_, frames_[count_ - 1].world_from_body, markers_);
    case Stage::kGuess:
      return guess_;
    case Stage::kFirstPlanar:
      return planar_[0];
    case Stage::kSecondPlanar:
      return planar_[1];
    case Stage::kCompare:
      return in_use;
    case Stage::kInUse:
    case Stage::kIdle:
      break;
  }
  return first_;
}

void ModeSearch::consider(const MarginalResection& solution) {
  MarginalResection& best = choice_.best;
  if (solution.ok && (!best.ok || solution.cost < best.cost - kBetter)) best = solution;
}

ModeSearch::Stage ModeSearch::afterGuess() {
  const bool fits = choice_.best.ok && choice_.best.cost <= kPoorFit * choice_.best.terms;
  planar_count_ = fits ? 0 : planarStarts(camera_, markers_, {order_.data(), count_}, planar_);
  return planar_count_ > 0 ? Stage::kFirstPlanar : Stage::kCompare;
}

void ModeSearch::take(const MarginalResection& solution) {
  if (stage_ == Stage::kCompare) {
    choice_.other_mode = choice_.best.ok && (!sameMode(refined_, choice_.best.camera_from_world) ||
                                             choice_.best.cost < solution.cost - kLost);
    stage_ = Stage::kIdle;
    return;
  }
  consider(solution);
  switch (stage_) {
    case Stage::kInUse:
      choice_.best = solution;
      refined_ = solution.camera_from_world;
      stage_ = Stage::kMirrored;
      break;
    case Stage::kMirrored:
      stage_ = Stage::kGuess;
      break;
    case Stage::kGuess:
      stage_ = afterGuess();
      break;
    case Stage::kFirstPlanar:
      stage_ = planar_count_ > 1 ? Stage::kSecondPlanar : Stage::kCompare;
      break;
    default:
      stage_ = Stage::kCompare;
      break;
  }
}

bool ModeSchedule::due() {
  if (++seen_ < next_) return false;
  next_ += next_ / 2;
  return true;
}

}  // namespace helical
