#include "engine/calibration/live_bound.h"

#include <array>

#include "engine/geometry/camera_perturbation.h"

namespace helical {
namespace {

constexpr std::size_t kMostWaiting = 64;
constexpr int kTakenPerFrame = 8;  // of those that wait
// Standard deviations below which an estimate serves: the bound then errs by some per cent.
constexpr double kSettledRotation = 0.01;  // rad
constexpr double kSettledPosition = 0.03;  // m
constexpr double kJumpRotation = 0.05;
constexpr double kJumpPosition = 0.15;

bool isSettled(const CameraEstimate& estimate) {
  const auto variances = estimate.covariance.diagonal();
  return variances.head<3>().sum() < kSettledRotation * kSettledRotation &&
         variances.tail<3>().sum() < kSettledPosition * kSettledPosition;
}

bool hasJumped(const RigidTransform& from, const RigidTransform& to) {
  const Vector6d change = cameraPerturbation(from, to);
  return change.head<3>().norm() > kJumpRotation || change.tail<3>().norm() > kJumpPosition;
}

}  // namespace

LiveBound::LiveBound() {
  waiting_.reserve(kMostWaiting);
}

void LiveBound::restart() {
  bound_ = {};
  waiting_.clear();
  stride_ = 1.0;
  skipped_ = 0.0;
  settled_ = false;
}

void LiveBound::take(const CameraModel& camera, const MarkerLayout& markers,
                     const RigidTransform& camera_from_world, const BoundFrame& frame) {
  std::array<MarkerId, kMaxMarkers> all;
  for (int m = 0; m < markers.count(); ++m) all[static_cast<std::size_t>(m)] = markerId(m);
  const double share = static_cast<double>(frame.balls) / markers.count();
  bound_.add(camera, camera_from_world, markers, {all.data(), static_cast<std::size_t>(markers.count())},
             frame.world_from_body, frame.pose_information, frame.sigma_px, share * frame.weight);
}

void LiveBound::wait(const BoundFrame& frame) {
  skipped_ += 1.0;
  if (skipped_ < stride_) return;
  skipped_ = 0.0;
  if (waiting_.size() == kMostWaiting) {
    for (std::size_t i = 0; i < kMostWaiting / 2; ++i) {
      waiting_[i] = waiting_[2 * i + 1];
      waiting_[i].weight *= 2.0;
    }
    waiting_.resize(kMostWaiting / 2);
    stride_ *= 2.0;
  }
  waiting_.push_back(frame);
  waiting_.back().weight *= stride_;
}

void LiveBound::add(const CameraModel& camera, const MarkerLayout& markers, const CameraEstimate& estimate,
                    const BoundFrame& frame) {
  if (settled_ && hasJumped(reference_, estimate.camera_from_world)) restart();
  if (!settled_ && isSettled(estimate)) {
    settled_ = true;
    reference_ = estimate.camera_from_world;
  }
  if (!settled_) {
    wait(frame);
    return;
  }
  take(camera, markers, estimate.camera_from_world, frame);
  for (int i = 0; i < kTakenPerFrame && !waiting_.empty(); ++i) {
    take(camera, markers, estimate.camera_from_world, waiting_.back());
    waiting_.pop_back();
  }
}

}  // namespace helical
