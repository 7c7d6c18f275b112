#include "engine/calibration/joint_smoother.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <string>

#include "engine/base/error.h"
#include "engine/geometry/camera_perturbation.h"

namespace helical {
namespace {

constexpr double kGrowth = 1.4;
constexpr int kShortestPause = 4;
// Beyond these a linearisation errs by more than a hundredth of a pixel, which thousands of centroids tell.
constexpr double kStaleRotation = 2e-3;  // rad
constexpr double kStalePosition = 4e-3;  // m
constexpr double kFarRotation = 0.02;
constexpr double kFarPosition = 0.05;
constexpr int kStaleShare = 8;  // a stale linearisation waits for so many frames' eighth
constexpr int kSlack = 64;      // frames that may come in during one pass

}  // namespace

void validate(const JointSmootherOptions& options) {
  if (options.kept_frames < 16 || options.kept_frames > 100000)
    throw Error(ErrorKind::kInput, "kept_frames of joint is " + std::to_string(options.kept_frames), {},
                "give 16 to 100000");
  if (!(options.robust_sigmas >= 1.0 && options.robust_sigmas <= 1000.0))
    throw Error(ErrorKind::kInput, "robust_sigmas of joint is " + std::to_string(options.robust_sigmas), {},
                "give 1 to 1000");
}

JointSmoother::Sum& JointSmoother::Sum::operator+=(const FrameInformation& frame) {
  hessian += frame.hessian;
  gradient += frame.gradient;
  return *this;
}

JointSmoother::JointSmoother(const JointSmootherOptions& options, const CameraModel& camera,
                             const MarkerLayout& markers)
    : options_((validate(options), options)),
      camera_(camera),
      markers_(markers),
      ring_(static_cast<std::size_t>(options.kept_frames + kSlack)) {}

void JointSmoother::start(const RigidTransform& camera_from_world, const Matrix6d& known) {
  first_ = kept_count_ = 0;
  frames_ = next_pass_ = last_pass_ = 0;
  linearisation_ = pose_ = camera_from_world;
  sum_ = condensed_ = {};
  sum_.hessian = condensed_.hessian = known;
  ahead_.setZero();
  passing_ = false;
}

const StoredFrame& JointSmoother::kept(int index) const {
  return ring_[static_cast<std::size_t>(first_ + index) % ring_.size()];
}

void JointSmoother::add(const StoredFrame& frame) {
  if (frame.count == 0) return;
  if (kept_count_ == static_cast<int>(ring_.size())) {
    passing_ = false;  // a pass that `work` never got to finish
    condenseOldest();
  }
  ring_[static_cast<std::size_t>(first_ + kept_count_) % ring_.size()] = frame;
  ++kept_count_;
  ++frames_;
  sum_ += frameInformation(camera_, markers_, frame, linearisation_, {options_.robust_sigmas, ahead_});
  solve();
}

void JointSmoother::solve() {
  const Vector6d step = -sum_.hessian.ldlt().solve(sum_.gradient);
  if (!step.allFinite()) return;
  ahead_ = step;
  pose_ = perturbCamera(linearisation_, ahead_);
}

void JointSmoother::condenseOldest() {
  condensed_ +=
      frameInformation(camera_, markers_, kept(0), linearisation_, {options_.robust_sigmas, ahead_});
  first_ = (first_ + 1) % static_cast<int>(ring_.size());
  --kept_count_;
}

bool JointSmoother::due() const {
  const long since = frames_ - last_pass_;
  if (since < kShortestPause) return false;
  if (frames_ >= next_pass_) return true;
  const double turned = ahead_.head<3>().norm(), moved = ahead_.tail<3>().norm();
  if (turned > kFarRotation || moved > kFarPosition) return true;
  return since * kStaleShare >= kept_count_ && (turned > kStaleRotation || moved > kStalePosition);
}

void JointSmoother::beginPass() {
  passing_ = true;
  pass_index_ = 0;
  pass_linearisation_ = pose_;
  pass_sum_ = {};
}

void JointSmoother::endPass() {
  passing_ = false;
  const Vector6d moved = cameraPerturbation(linearisation_, pass_linearisation_);
  condensed_.gradient += condensed_.hessian * moved;
  linearisation_ = pass_linearisation_;
  sum_.hessian = pass_sum_.hessian + condensed_.hessian;
  sum_.gradient = pass_sum_.gradient + condensed_.gradient;
  last_pass_ = frames_;
  next_pass_ = std::max(frames_ + kShortestPause, static_cast<long>(kGrowth * static_cast<double>(frames_)));
  solve();
}

void JointSmoother::work(int frames) {
  if (!passing_) {
    for (; frames > 0 && kept_count_ > options_.kept_frames; --frames) condenseOldest();
    if (!due()) return;
    beginPass();
  }
  for (; frames > 0 && pass_index_ < kept_count_; --frames)
    pass_sum_ += frameInformation(camera_, markers_, kept(pass_index_++), pass_linearisation_,
                                  {options_.robust_sigmas, Vector6d::Zero()});
  if (pass_index_ == kept_count_) endPass();
}

}  // namespace helical
