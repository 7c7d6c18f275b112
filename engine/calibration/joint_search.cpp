#include "engine/calibration/joint_search.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>

#include "engine/base/error.h"
#include "engine/calibration/camera_perturbation.h"
#include "engine/geometry/camera_perturbation.h"

namespace helical {
namespace {

constexpr double kRobustSigmas = 4.0;
constexpr double kMedianToScale = 2.5;    // 1.18 sigma is the median of a good fit: stays below the scale
constexpr double kMedianSquared = 1.386;  // of a chi-square of 2 degrees of freedom
constexpr double kInlierSigmas = 6.0;
constexpr double kSeedRmsPx = 2.0,
                 kSeedSigmas = 4.0;  // whichever is more: how badly a seed may fit its frame
constexpr double kSeedRotation = 0.02, kSeedPosition = 0.06;  // how far off a planar pose may be [rad, m]
constexpr double kSameRotation = 0.02, kSamePosition = 0.06;
constexpr double kNoiseAlone = 1.25;  // variance that the median of some twenty frames may show by chance
constexpr double kLastingGap = 8.0;
constexpr int kIterations = 12;
constexpr int kFairIterations = 4;
constexpr double kHopelessChi2 = 200.0;
constexpr double kSettledDecrease = 0.05;  // squared sigmas
constexpr double kFarthestM = 50.0;
constexpr int kSeedings = 3, kSeedingPause = 5, kLaterPause = 60;
constexpr int kFewestCentroids = 3;
constexpr int kPatience = 45;  // frames without all balls and them alone, before one less or more will do

double robustCost(double squared, double scale) {
  const double limit = scale * scale;
  return squared <= limit ? squared : limit * (2.0 - limit / squared);
}

bool sameMode(const RigidTransform& a, const RigidTransform& b) {
  const Vector6d change = cameraPerturbation(a, b);
  return change.head<3>().norm() < kSameRotation && change.tail<3>().norm() < kSamePosition;
}

double typicalSigma(const Observation& observation) {
  return std::sqrt(0.5 * observation.centroids[0].covariance.trace());
}

}  // namespace

void validate(const JointSearchOptions& options) {
  const auto require = [](bool good, const char* key, double value, const char* cure) {
    if (!good)
      throw Error(ErrorKind::kInput, std::string(key) + " of joint is " + std::to_string(value), {}, cure);
  };
  require(options.prune_chi2 > 0.0 && options.prune_chi2 <= 1e6, "prune_chi2", options.prune_chi2,
          "give a number above 0, at most 1e6");
  require(options.prune_frames >= 1 && options.prune_frames <= JointSearch::kMaxFrames, "prune_frames",
          options.prune_frames, "give 1 to 24");
  require(options.lock_frames >= options.prune_frames && options.lock_frames <= JointSearch::kMaxFrames,
          "lock_frames", options.lock_frames, "give prune_frames to 24");
  require(options.lock_inliers > 0.0 && options.lock_inliers <= 1.0, "lock_inliers", options.lock_inliers,
          "give a share above 0");
  require(options.lock_median > 1.2 && options.lock_median <= 100.0, "lock_median", options.lock_median,
          "give a number above 1.2");
}

JointSearch::JointSearch(const JointSearchOptions& options, const CameraModel& camera,
                         const MarkerLayout& markers)
    : options_((validate(options), options)),
      camera_(camera),
      markers_(markers),
      store_(kMaxFrames),
      seeds_(camera_, markers) {}

Matrix6d JointSearch::Hypothesis::covariance() const {
  if (!(hessian.diagonal().minCoeff() > 0.0)) {
    Matrix6d wide = Matrix6d::Zero();
    wide.diagonal().head<3>().setConstant(kSeedRotation * kSeedRotation);
    wide.diagonal().tail<3>().setConstant(kSeedPosition * kSeedPosition);
    return wide;
  }
  return hessian.ldlt().solve(Matrix6d::Identity());
}

void JointSearch::clear() {
  store_.clear();
  waiting_count_ = 0;
  seeds_.stop();
  since_seeding_ = seedings_ = since_whole_ = 0;
  count_ = in_round_count_ = 0;
  in_round_ = decided_ = false;
}

void JointSearch::step(const UnnamedFrame& frame, int units) {
  if (frame.observation.count < kFewestCentroids) return;
  seed(frame);
  if (waiting_count_ == kMaxFrames) {  // a long round: the newest frames tell more than older ones
    std::move(waiting_.begin() + 1, waiting_.end(), waiting_.begin());
    --waiting_count_;
  }
  waiting_[static_cast<std::size_t>(waiting_count_++)] = frame;
  if (!in_round_) beginRound();
  while (units > 0) {
    Hypothesis* next = unsettled();
    if (next == nullptr) {
      endRound();
      return;
    }
    improve(*next);
    units -= static_cast<int>(store_.frames().size());
  }
}

bool JointSearch::wantsSeeds() const {
  if (count_ == 0) return true;
  const bool doubtful = hypotheses_[0].inliers < options_.lock_inliers * centroids_;
  if (seedings_ < kSeedings || doubtful) return since_seeding_ >= kSeedingPause;
  return since_seeding_ >= kLaterPause;
}

/// A ball may be hidden for good, or a lamp be taken for one.
bool JointSearch::canSeed(int centroids) {
  since_whole_ = centroids == markers_.count() ? 0 : since_whole_ + 1;
  return since_whole_ == 0 || (since_whole_ > kPatience && seeds_.accepts(centroids));
}

void JointSearch::seed(const UnnamedFrame& frame) {
  ++since_seeding_;
  const bool suitable = canSeed(frame.observation.count);
  if (seeds_.done()) {
    if (!suitable || !wantsSeeds()) return;
    std::array<Eigen::Vector2d, kMaxMarkers> pixels;
    for (int c = 0; c < frame.observation.count; ++c)
      pixels[static_cast<std::size_t>(c)] = frame.observation.centroids[static_cast<std::size_t>(c)].pixel;
    seeds_.start({pixels.data(), static_cast<std::size_t>(frame.observation.count)}, ViewSide::kEither);
    seed_world_from_body_ = frame.world_from_body;
    since_seeding_ = 0;
  }
  const double largest_rms_px = std::max(kSeedRmsPx, kSeedSigmas * typicalSigma(frame.observation));
  if (const auto found = seeds_.next(largest_rms_px))
    for (int i = 0; i < found->poses.count; ++i)
      if (const PlanarPose& pose = found->poses.poses[static_cast<std::size_t>(i)];
          pose.rms_px < largest_rms_px)
        addHypothesis(pose.camera_from_body * seed_world_from_body_.inverse());
  if (seeds_.done()) ++seedings_;
}

void JointSearch::addHypothesis(const RigidTransform& camera_from_world) {
  const bool known = std::any_of(
      hypotheses_.begin(), hypotheses_.begin() + count_,
      [&](const Hypothesis& other) { return sameMode(other.camera_from_world, camera_from_world); });
  if (known || count_ == kMaxHypotheses) return;
  Hypothesis& fresh = hypotheses_[static_cast<std::size_t>(count_++)];
  fresh = {};
  fresh.camera_from_world = camera_from_world;
}

void JointSearch::beginRound() {
  for (int i = 0; i < waiting_count_; ++i) store_.add(waiting_[static_cast<std::size_t>(i)]);
  waiting_count_ = 0;
  centroids_ = 0;
  for (const UnnamedFrame* frame : store_.frames()) centroids_ += frame->observation.count;
  for (int i = 0; i < count_; ++i) {
    Hypothesis& hypothesis = hypotheses_[static_cast<std::size_t>(i)];
    hypothesis.evaluated = hypothesis.settled = false;
    hypothesis.iterations = 0;
    hypothesis.damping = 1e-3;
  }
  in_round_count_ = count_;
  in_round_ = true;
}

/// The one to work on next: those not looked at in this round, then the most promising.
JointSearch::Hypothesis* JointSearch::unsettled() {
  Hypothesis* next = nullptr;
  for (int i = 0; i < in_round_count_; ++i) {
    Hypothesis& each = hypotheses_[static_cast<std::size_t>(i)];
    if (each.settled) continue;
    if (each.iterations == 0) return &each;
    if (next == nullptr || each.rank_cost < next->rank_cost) next = &each;
  }
  return next;
}

/// Far behind after some iterations: more of them are for the others.
bool JointSearch::hopeless(const Hypothesis& hypothesis) const {
  if (hypothesis.iterations < kFairIterations) return false;
  double best = hypothesis.rank_cost;
  for (int i = 0; i < in_round_count_; ++i)
    if (const Hypothesis& other = hypotheses_[static_cast<std::size_t>(i)]; other.iterations > 0)
      best = std::min(best, other.rank_cost);
  return hypothesis.rank_cost > 2.0 * best + kHopelessChi2;
}

JointSearch::Hypothesis JointSearch::evaluate(const RigidTransform& pose, const Matrix6d& covariance,
                                              double scale) const {
  Hypothesis result;
  result.camera_from_world = pose;
  result.scale = scale;
  result.evaluated = true;
  std::array<double, kMaxFrames * kMaxMarkers> squares;
  std::size_t count = 0;
  StoredFrame named;
  for (const UnnamedFrame* frame : store_.frames()) {
    nameCentroids(camera_, markers_, pose, covariance, *frame, named);
    for (int i = 0; i < named.count; ++i) {
      const LabelledPixel& seen = named.pixels[static_cast<std::size_t>(i)];
      const auto ball = projectMarker(camera_, pose, named.world_from_body, markers_.inBody(seen.marker));
      if (!ball) continue;
      const Eigen::Matrix2d allowed =
          seen.covariance + ball->d_pose * named.pose_covariance * ball->d_pose.transpose();
      const Eigen::Matrix2d information = allowed.inverse();
      const Eigen::Vector2d residual = ball->pixel - seen.pixel;
      const double squared = residual.dot(information * residual);
      const double ratio = scale * scale / std::max(squared, 1e-12);
      const Eigen::Matrix<double, 6, 2> weighted =
          (ratio >= 1.0 ? 1.0 : ratio * ratio) * ball->d_camera.transpose() * information;
      result.hessian.noalias() += weighted * ball->d_camera;
      result.gradient.noalias() += weighted * residual;
      result.cost += robustCost(squared, scale);
      result.rank_cost += robustCost(squared, kRobustSigmas);
      result.inliers += squared < kInlierSigmas * kInlierSigmas;
      squares[count++] = squared;
    }
  }
  const double without_name = 2.0 * (centroids_ - static_cast<int>(count));
  result.cost += without_name * scale * scale;
  result.rank_cost += without_name * kRobustSigmas * kRobustSigmas;
  if (count == 0) return result;
  const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(squares.begin(), middle, squares.begin() + static_cast<std::ptrdiff_t>(count));
  result.median_sigmas = std::sqrt(*middle);
  return result;
}

double JointSearch::misfit(const Hypothesis& hypothesis) const {
  return centroids_ > 0 ? std::sqrt(0.5 * hypothesis.rank_cost / centroids_) : 0.0;
}

void JointSearch::improve(Hypothesis& hypothesis) {
  const int iterations = hypothesis.iterations + 1;
  const double damping = hypothesis.damping;
  const double scale = std::max(kRobustSigmas, kMedianToScale * hypothesis.median_sigmas);
  if (!hypothesis.evaluated) {
    hypothesis = evaluate(hypothesis.camera_from_world, hypothesis.covariance(), scale);
    hypothesis.iterations = iterations;
    hypothesis.damping = damping;
    hypothesis.settled = iterations >= kIterations;
    return;
  }
  Matrix6d damped = hypothesis.hessian;
  damped.diagonal() *= 1.0 + damping;
  const Vector6d step = -damped.ldlt().solve(hypothesis.gradient);
  hypothesis.iterations = iterations;
  if (!step.allFinite()) {
    hypothesis.settled = true;
    return;
  }
  const Hypothesis trial =
      evaluate(perturbCamera(hypothesis.camera_from_world, step), hypothesis.covariance(), hypothesis.scale);
  const double decrease = hypothesis.cost - trial.cost;
  if (decrease > 0.0) {
    hypothesis = trial;
    hypothesis.iterations = iterations;
    hypothesis.damping = 0.2 * damping;
    const double wanted = std::max(kRobustSigmas, kMedianToScale * trial.median_sigmas);
    hypothesis.evaluated = std::abs(wanted - trial.scale) < 0.05 * trial.scale;
    hypothesis.settled = hypothesis.evaluated && decrease < kSettledDecrease;
  } else {
    hypothesis.damping = std::max(8.0 * damping, 1e-6);
    hypothesis.settled = hypothesis.damping > 1e3 || step.norm() < 1e-6 || decrease > -kSettledDecrease;
  }
  hypothesis.settled = hypothesis.settled || iterations >= kIterations || hopeless(hypothesis);
}

/// Far away, or it would see the balls through the landing pad: mirrored at the balls' plane a camera fits
/// nearly as well while the helicopter stands or hardly flies. The pad reaches as far as the balls of a
/// helicopter on it; it may hide balls from a camera below it, so that only frames which show all of them
/// speak against one.
bool JointSearch::isImpossible(const RigidTransform& camera_from_world) const {
  const Eigen::Vector3d eye = camera_from_world.inverseTranslation();
  if (!camera_from_world.translation.allFinite() || eye.norm() > kFarthestM) return true;
  if (eye.z() >= 0.0) return false;
  double pad = 0.0;
  for (const Eigen::Vector3d& ball : markers_.all()) pad = std::max(pad, ball.head<2>().norm());
  for (const UnnamedFrame* frame : store_.frames()) {
    if (frame->observation.count < markers_.count()) continue;
    for (const Eigen::Vector3d& in_body : markers_.all()) {
      const Eigen::Vector3d ball = frame->world_from_body * in_body;
      if (ball.z() <= 0.0) continue;
      const Eigen::Vector3d through = ball + ball.z() / (ball.z() - eye.z()) * (eye - ball);
      if (through.head<2>().norm() < pad) return true;
    }
  }
  return false;
}

void JointSearch::prune() {
  const auto end =
      std::remove_if(hypotheses_.begin(), hypotheses_.begin() + in_round_count_,
                     [this](const Hypothesis& each) { return isImpossible(each.camera_from_world); });
  std::sort(hypotheses_.begin(), end,
            [](const Hypothesis& a, const Hypothesis& b) { return a.rank_cost < b.rank_cost; });
  const Hypothesis& best = hypotheses_[0];
  // Where even the best fits badly, sigma is too small: the gap grows with it. And then the balls are not
  // where they are said to be: such errors do not average out, and for frames that look alike a wrong name or
  // a camera mirrored at the balls' plane may fit better by chance. So much more is asked for, which motion
  // brings.
  const double variance = std::max(1.0, best.median_sigmas * best.median_sigmas / kMedianSquared);
  const double lasting = kLastingGap * std::max(0.0, variance - kNoiseAlone);
  const double gap = options_.prune_chi2 * variance * (1.0 + lasting);
  const bool enough = static_cast<int>(store_.frames().size()) >= options_.prune_frames;
  const auto possible = static_cast<int>(end - hypotheses_.begin());
  int kept = 0;
  for (int i = 0; i < possible; ++i) {
    const Hypothesis& each = hypotheses_[static_cast<std::size_t>(i)];
    if (i > 0 && enough && each.rank_cost - best.rank_cost > gap) break;
    const bool twin = std::any_of(
        hypotheses_.begin(), hypotheses_.begin() + kept,
        [&](const Hypothesis& other) { return sameMode(other.camera_from_world, each.camera_from_world); });
    if (!twin) hypotheses_[static_cast<std::size_t>(kept++)] = each;
  }
  // Those that came during the round are still to be looked at.
  for (int i = in_round_count_; i < count_; ++i)
    hypotheses_[static_cast<std::size_t>(kept++)] = hypotheses_[static_cast<std::size_t>(i)];
  count_ = kept;
}

void JointSearch::endRound() {
  in_round_ = false;
  if (in_round_count_ == 0) return;
  prune();
  decided_ = count_ == 1 && seedings_ >= kSeedings && seeds_.done() &&
             hypotheses_[0].median_sigmas < options_.lock_median &&
             static_cast<int>(store_.frames().size()) >= options_.lock_frames &&
             hypotheses_[0].inliers >= options_.lock_inliers * centroids_;
}

}  // namespace helical
