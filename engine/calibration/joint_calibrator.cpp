#include "engine/calibration/joint_calibrator.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <string>

#include "engine/base/error.h"
#include "engine/geometry/camera_perturbation.h"

namespace helical {
namespace {

constexpr int kRecentFrames = 256;
constexpr int kUnitsPerLearnt = 3;     // naming and adding a frame costs as much as so many looks at one
constexpr double kFittingFrames = 45;  // that the running share rests on
constexpr int kFewestToJudge = 3;
constexpr double kLostBelow = 0.2;

}  // namespace

void validate(const JointOptions& options) {
  validate(options.search);
  validate(options.smoother);
  const LastingOffsets& lasting = options.lasting;
  if (!(lasting.sigma_px >= 0.0 && lasting.sigma_px <= 100.0))
    throw Error(ErrorKind::kInput, "sigma_px of lasting offsets is " + std::to_string(lasting.sigma_px), {},
                "give 0 (none) to 100");
  if (!(lasting.time_s > 0.0 && lasting.time_s <= 3600.0))
    throw Error(ErrorKind::kInput, "time_s of lasting offsets is " + std::to_string(lasting.time_s), {},
                "give a time above 0, at most 3600 s");
  if (options.frame_units < 6 || options.frame_units > 10000)
    throw Error(ErrorKind::kInput, "frame_units of joint is " + std::to_string(options.frame_units), {},
                "give 6 to 10000");
}

JointCalibrator::JointCalibrator(const JointOptions& options, const GuessSpread& spread,
                                 const CameraModel& camera, const MarkerLayout& markers)
    : options_((validate(options), options)),
      spread_(spread),
      markers_(markers),
      camera_(camera),
      search_(options.search, camera, markers),
      smoother_(options.smoother, camera, markers),
      recent_(kRecentFrames) {
  restart({});
}

void JointCalibrator::restart(const RigidTransform& initial_guess) {
  guess_ = initial_guess;
  estimate_ = {initial_guess, covarianceOf(spread_), CameraStatus::kCalibrating};
  forget();
}

void JointCalibrator::forget() {
  search_.clear();
  first_ = recent_count_ = 0;
  locked_ = current_named_ = false;
  learnt_frames_ = learnt_variance_ = 0.0;
  learnt_from_ = learnt_to_ = 0;
  known_.setZero();
  fitting_ = 1.0;
  labellings_ = {};
}

bool JointCalibrator::goOnFrom(const CameraEstimate& estimate) {
  const double learnt_s = toSeconds(learnt_to_ - learnt_from_);
  const Eigen::LDLT<Matrix6d> factor(estimate.covariance);
  if (!locked_ || !(learnt_s > 0.0) || !factor.isPositive() || !(factor.vectorD().minCoeff() > 0.0)) return false;
  // Frames to come tell less than the smoother takes them for, by what lasting offsets inflate in the long run:
  // so what is known already has to weigh as much more.
  const double per_time_constant = learnt_frames_ * options_.lasting.time_s / learnt_s;
  const double centroid_variance = learnt_variance_ / learnt_frames_;
  const double weight =
      1.0 + 2.0 * per_time_constant * options_.lasting.sigma_px * options_.lasting.sigma_px / centroid_variance;
  const Matrix6d known = factor.solve(Matrix6d::Identity());
  forget();
  locked_ = true;
  known_ = 0.5 * (known + known.transpose());
  known_weight_ = weight;
  smoother_.start(estimate.camera_from_world, known_weight_ * known_);
  estimate_ = {estimate.camera_from_world, estimate.covariance, CameraStatus::kCalibrating};
  return true;
}

std::span<const LabelledPixel> JointCalibrator::named() const {
  if (!current_named_) return {};
  return {named_.pixels.data(), static_cast<std::size_t>(named_.count)};
}

void JointCalibrator::remember(const CalibrationFrame& frame) {
  if (recent_count_ == kRecentFrames) {
    first_ = (first_ + 1) % kRecentFrames;
    --recent_count_;
  }
  recent_[static_cast<std::size_t>((first_ + recent_count_++) % kRecentFrames)] = {
      frame.world_from_body, frame.pose_covariance, *frame.observation};
}

void JointCalibrator::step(const CalibrationFrame& frame) {
  current_named_ = false;
  if (frame.observation == nullptr || frame.observation->count == 0) return;
  remember(frame);
  if (!locked_)
    seek();
  else
    learn();
}

/// The newest frame has every ball's name under each hypothesis. With every round, not with every frame: it costs as
/// much as learning from so many frames.
void JointCalibrator::noteLabellings(const UnnamedFrame& frame) {
  labellings_ = {};
  labellings_.by_misfit = true;
  for (const JointSearch::Hypothesis& each : search_.hypotheses()) {
    if (!each.evaluated) continue;
    if (labellings_.count == TriedLabellings::kMost) break;  // they come in the order of their cost
    nameCentroids(camera_, markers_, each.camera_from_world, each.covariance(), frame, named_);
    std::array<std::uint8_t, kMaxMarkers> markers{};
    std::array<Eigen::Vector2d, kMaxMarkers> pixels;
    const auto count = static_cast<std::size_t>(named_.count);
    for (std::size_t i = 0; i < count; ++i) {
      markers[i] = static_cast<std::uint8_t>(named_.pixels[i].marker.index());
      pixels[i] = named_.pixels[i].pixel;
    }
    labellings_.add(fromLeftToRight({markers.data(), count}, {pixels.data(), count}, search_.misfit(each)));
  }
}

void JointCalibrator::seek() {
  const UnnamedFrame& newest = recent_[static_cast<std::size_t>((first_ + recent_count_ - 1) % kRecentFrames)];
  search_.step(newest, options_.frame_units);
  if (search_.roundEnded() && newest.observation.count >= kFewestToJudge) noteLabellings(newest);
  const auto hypotheses = search_.hypotheses();
  if (hypotheses.empty()) return;
  if (search_.decided()) {
    locked_ = true;
    smoother_.start(hypotheses.front().camera_from_world);
    estimate_.camera_from_world = hypotheses.front().camera_from_world;
    estimate_.covariance = hypotheses.front().covariance();
    return;
  }
  // While several explain the frames, the guess is as good a judge as any.
  const auto distance = [&](const JointSearch::Hypothesis& hypothesis) {
    const Vector6d change = cameraPerturbation(guess_, hypothesis.camera_from_world);
    return change.head<3>().norm() / spread_.rotation_rad + change.tail<3>().norm() / spread_.position_m;
  };
  const auto& nearest =
      *std::min_element(hypotheses.begin(), hypotheses.end(),
                        [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  estimate_.camera_from_world = nearest.camera_from_world;
  // How well the frames fix it if it is the right one says nothing of whether it is: until that is decided no more is
  // claimed than of the guess.
  estimate_.covariance = covarianceOf(spread_) + nearest.covariance();
  for (const auto& hypothesis : hypotheses) {
    const Vector6d apart = cameraPerturbation(nearest.camera_from_world, hypothesis.camera_from_world);
    estimate_.covariance += apart * apart.transpose() / static_cast<double>(hypotheses.size());
  }
}

bool JointCalibrator::lost(const UnnamedFrame& frame) {
  // Of one or two regions nobody can say whether they are the helicopter: a covered camera forgets nothing.
  if (frame.observation.count < kFewestToJudge) return false;
  const int expected = std::min(frame.observation.count, markers_.count());
  const double share = static_cast<double>(named_.count) / expected;
  fitting_ += (share - fitting_) / kFittingFrames;
  return fitting_ < kLostBelow;
}

void JointCalibrator::learn() {
  int units = options_.frame_units;
  for (; units > 0 && recent_count_ > 0; units -= kUnitsPerLearnt) {
    const UnnamedFrame& frame = recent_[static_cast<std::size_t>(first_)];
    nameCentroids(camera_, markers_, estimate_.camera_from_world, estimate_.covariance, frame, named_);
    first_ = (first_ + 1) % kRecentFrames;
    --recent_count_;
    if (lost(frame)) {
      forget();
      return;
    }
    smoother_.add(named_);
    countNoise(frame);
  }
  smoother_.work(units);
  current_named_ = recent_count_ == 0;
  const Eigen::LDLT<Matrix6d> factor(smoother_.information());
  if (!factor.isPositive() || !(factor.vectorD().minCoeff() > 0.0)) return;
  estimate_.camera_from_world = smoother_.pose();
  const Matrix6d covariance = factor.solve(Matrix6d::Identity());
  const double inflation = noiseInflation();
  estimate_.covariance = inflation * covariance;
  if (known_.isZero(0.0)) return;
  // Of a weighted mean of what was known and of the frames since.
  const double beyond = known_weight_ * (known_weight_ - inflation);
  estimate_.covariance += beyond * covariance * known_ * covariance;
}

void JointCalibrator::countNoise(const UnnamedFrame& frame) {
  if (learnt_frames_ == 0.0) learnt_from_ = frame.observation.exposure;
  learnt_to_ = frame.observation.exposure;
  learnt_frames_ += 1.0;
  learnt_variance_ += 0.5 * frame.observation.centroids[0].covariance.trace();
}

/// By how much the variance of a mean over the frames is larger than independent noise would have it. The
/// helicopter's pose comes from centroids with the same offsets, so that one factor serves for both.
double JointCalibrator::noiseInflation() const {
  const double time_constant = options_.lasting.time_s;
  const double elapsed = toSeconds(learnt_to_ - learnt_from_) / time_constant;
  if (!(elapsed > 0.0)) return 1.0;
  const double decorrelated = 2.0 / elapsed * (1.0 - (1.0 - std::exp(-elapsed)) / elapsed);
  const double variance = options_.lasting.sigma_px * options_.lasting.sigma_px;
  return 1.0 + decorrelated * learnt_frames_ * learnt_frames_ * variance / learnt_variance_;
}

}  // namespace helical
