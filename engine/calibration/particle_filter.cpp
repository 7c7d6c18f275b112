#include "engine/calibration/particle_filter.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <string>

#include "engine/base/error.h"
#include "engine/geometry/rotation.h"

namespace helical {
namespace {

constexpr int kMaxTemperings = 8;
constexpr int kBisections = 10;

void require(bool good, const char* key, double value, const char* cure) {
  if (!good)
    throw Error(ErrorKind::kInput, std::string(key) + " of the particle filter is " + std::to_string(value),
                {}, cure);
}

/// Pixels per bearing at a centroid.
Eigen::Matrix2d pixelPerBearing(const CameraModel& camera, const Eigen::Vector2d& bearing) {
  Eigen::Matrix<double, 2, 3> d_point;
  if (!camera.project(bearing.homogeneous(), &d_point))
    return Eigen::Vector2d(camera.fx(), camera.fy()).asDiagonal();
  return d_point.leftCols<2>();
}

}  // namespace

void validate(const ParticleFilterOptions& options) {
  require(options.particles >= 10 && options.particles <= 1'000'000, "particles", options.particles,
          "give 10 to 1000000");
  require(options.sigma_factor > 0.0 && options.sigma_factor <= 1000.0, "sigma_factor", options.sigma_factor,
          "give a number above 0, at most 1000");
  require(options.floor >= 1e-12 && options.floor <= 1.0, "floor", options.floor, "give 1e-12 to 1");
  require(options.kernel >= 0.0 && options.kernel < 1.0, "kernel", options.kernel,
          "give 0 (none) or more, below 1");
  require(options.resample_share > 0.0 && options.resample_share <= 1.0, "resample_share",
          options.resample_share, "give a share above 0, at most 1");
  require(options.temper_share >= 0.0 && options.temper_share < 1.0, "temper_share", options.temper_share,
          "give 0 (never) or a share below 1");
  require(options.literal_sigma_px > 0.0 && options.literal_sigma_px <= 1000.0, "literal_sigma_px",
          options.literal_sigma_px, "give a number above 0, at most 1000");
  require(options.start_inflation >= 1.0 && options.start_inflation <= 100.0, "start_inflation",
          options.start_inflation, "give 1 to 100");
}

ParticleFilter::ParticleFilter(ParticleFilterKind kind, const ParticleFilterOptions& options,
                               const GuessSpread& spread, const CameraModel& camera,
                               const MarkerLayout& markers, std::uint64_t seed)
    : kind_(kind),
      options_((validate(options), options)),
      spread_(spread),
      camera_(camera),
      markers_(markers),
      seed_(seed),
      cloud_(options.particles, seed),
      store_(static_cast<int>(kModeFrames)),
      search_(camera, markers),
      log_likelihoods_(static_cast<std::size_t>(options.particles)) {
  restart({});
}

void ParticleFilter::restart(const RigidTransform& initial_guess) {
  cloud_.restart(seed_);
  store_.clear();
  schedule_ = {};
  search_.stop();
  search_due_ = false;
  guess_ = initial_guess;
  estimate_ = {initial_guess, covarianceOf(spread_), CameraStatus::kCalibrating};
  started_ = kind_ == ParticleFilterKind::kLiteral;
  if (started_) cloud_.seed(guess_, estimate_.covariance);
}

std::span<const WeightedPose> ParticleFilter::particles() const {
  if (!started_) return {};
  return cloud_.poses();
}

void ParticleFilter::step(const CalibrationFrame& frame) {
  if (frame.pixels.empty()) return;
  if (kind_ == ParticleFilterKind::kStabilised) {
    store_.add(frame);
    considerModes();
  }
  if (started_) filter(frame);
}

void ParticleFilter::considerModes() {
  search_due_ = schedule_.due() || search_due_;
  if (search_due_ && !search_.running()) {
    search_due_ = false;
    search_.start(store_.frames(), estimate_.camera_from_world, guess_);
  }
  if (!search_.running()) return;
  int budget = kFramesPerStep;
  search_.advance(estimate_.camera_from_world, budget);
  if (search_.running()) return;
  const ModeChoice& choice = search_.choice();
  if (choice.best.ok && (!started_ || choice.other_mode)) seedAround(choice.best);
}

void ParticleFilter::seedAround(const MarginalResection& resection) {
  const double inflation = options_.start_inflation * options_.start_inflation;
  cloud_.seed(resection.camera_from_world, inflation * resection.information.inverse());
  started_ = true;
}

Eigen::Matrix2d ParticleFilter::pixelCovariance(const CalibrationFrame& frame,
                                                const LabelledPixel& seen) const {
  if (kind_ == ParticleFilterKind::kLiteral)
    return options_.literal_sigma_px * options_.literal_sigma_px * Eigen::Matrix2d::Identity();
  Eigen::Matrix2d covariance = options_.sigma_factor * options_.sigma_factor * seen.covariance;
  const auto ball = projectMarker(camera_, estimate_.camera_from_world, frame.world_from_body,
                                  markers_.inBody(seen.marker));
  // An error of the helicopter's pose is common to all balls, the likelihood takes each for itself: n times
  // the variance makes them say together what one of them may.
  if (ball)
    covariance += static_cast<double>(frame.pixels.size()) * ball->d_pose * frame.pose_covariance *
                  ball->d_pose.transpose();
  return covariance;
}

std::span<const BearingTarget> ParticleFilter::targets(const CalibrationFrame& frame) {
  std::size_t count = 0;
  for (const LabelledPixel& seen : frame.pixels) {
    if (count == targets_.size()) break;
    BearingTarget& target = targets_[count++];
    target.ball_in_world = frame.world_from_body * markers_.inBody(seen.marker);
    target.bearing = camera_.bearing(seen.pixel);
    const Eigen::Matrix2d covariance = pixelCovariance(frame, seen);
    target.whitening = covariance.llt().matrixL().solve(pixelPerBearing(camera_, target.bearing));
    target.peak = 1.0 / (std::sqrt(2.0 * kPi) * std::pow(covariance.determinant(), 0.25));
  }
  return {targets_.data(), count};
}

double ParticleFilter::temperedExponent(double remaining) {
  const double least = options_.temper_share * options_.particles;
  if (cloud_.effectiveSampleSizeAfter(log_likelihoods_, remaining) >= least) return remaining;
  double low = 0.0, high = remaining;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (low + high);
    (cloud_.effectiveSampleSizeAfter(log_likelihoods_, middle) < least ? high : low) = middle;
  }
  return std::max(low, 1e-6);
}

void ParticleFilter::filter(const CalibrationFrame& frame) {
  const bool literal = kind_ == ParticleFilterKind::kLiteral;
  const auto seen = targets(frame);
  double remaining = 1.0;
  for (int i = 0; i <= kMaxTemperings && remaining > 0.0; ++i) {
    logLikelihoods(cloud_, seen, options_.floor,
                   literal ? LikelihoodProduct::kPerCamera : LikelihoodProduct::kPerMarker, log_likelihoods_);
    const bool temper = !literal && i < kMaxTemperings;
    const double exponent = temper ? temperedExponent(remaining) : remaining;
    cloud_.reweigh(log_likelihoods_, exponent);
    remaining -= exponent;
    if (cloud_.effectiveSampleSize() < options_.resample_share * options_.particles)
      cloud_.resample(literal ? 0.0 : options_.kernel);
  }
  const CloudMoments moments = cloud_.moments();
  estimate_.camera_from_world = cloud_.pose(moments.mean);
  estimate_.covariance = moments.covariance;
}

}  // namespace helical
