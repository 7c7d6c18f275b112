#include "engine/calibration/step_detector.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/base/require.h"

namespace helical {
namespace {

constexpr TimeNs kSameTime = 25 * kNanosecondsPerMillisecond;
constexpr TimeNs kLongestFrame = 40 * kNanosecondsPerMillisecond;  // on average over a track
constexpr std::size_t kFewestBalls = 3;
constexpr int kFewestCameras = 3;
constexpr double kPerSecond = 10.0;  // unit of time of the fit: its matrix is well scaled
constexpr double kLargestMisfit = 2.5;  // over a centroid's variance: one false centroid among them is more
// Centroids' noise is learnt over so many frames, from what their covariance claims; so is the helicopter's motion.
constexpr double kNoiseFrames = 120, kMotionFrames = 500;
constexpr double kLeastNoise = 0.25, kMostNoise = 2.0;  // variance over the one claimed
// Variance of the motion that a step must not be taken for, over the usual one.
constexpr double kMotionAllowance = 4.0;
// On average over all cameras: more is a jolt of the helicopter, which no parabola follows.
constexpr double kCalmMisfit = 1.4;
// Noise beyond what was learnt, as many standard deviations of a mean misfit beyond one as are no chance.
constexpr double kUnrestSigmas = 2.0;
constexpr double kLeastJerkM = 1e-6;
constexpr double kAlikeSigmas = 3.0;  // from the median: balls whose steps count
constexpr double kChosenLoss = 1.05;  // variance of the mean of those over that of all

struct BallStep {
  Eigen::Vector2d pixels = Eigen::Vector2d::Zero();
  double variance = 0.0;  ///< over that of a centroid
  double misfit = 0.0;    ///< variance of what is left, per axis [px^2]
  double of_cube = 0.0;   ///< step that time cubed would give
};

/// Least squares of a parabola and a step along one ball's track.
class TrackFit {
 public:
  void add(double time, bool after, const Eigen::Vector2d& pixel) {
    const Eigen::Vector4d row(1.0, time, time * time, after ? 0.5 : -0.5);
    normal_.noalias() += row * row.transpose();
    right_.noalias() += row * pixel.transpose();
    cubes_.noalias() += row * (time * time * time);
    squares_ += pixel.squaredNorm();
    ++count_[after];
  }
  /// Nothing where more than one frame before or after is missing.
  std::optional<BallStep> step(int before, int after) const {
    if (count_[0] < before - 1 || count_[1] < std::max(2, after - 1)) return std::nullopt;
    const Eigen::LDLT<Eigen::Matrix4d> factor(normal_);
    const Eigen::Vector4d column = factor.solve(Eigen::Vector4d::UnitW());
    if (!column.allFinite() || !(column[3] > 0.0)) return std::nullopt;
    const Eigen::Matrix<double, 4, 2> solution = factor.solve(right_);
    const double left = squares_ - solution.cwiseProduct(right_).sum();
    return BallStep{right_.transpose() * column, column[3], left / (2.0 * (count_[0] + count_[1] - 4)),
                    cubes_.dot(column)};
  }

 private:
  Eigen::Matrix4d normal_ = Eigen::Matrix4d::Zero();
  Eigen::Matrix<double, 4, 2> right_ = Eigen::Matrix<double, 4, 2>::Zero();
  Eigen::Vector4d cubes_ = Eigen::Vector4d::Zero();
  double squares_ = 0.0;
  std::array<int, 2> count_{};
};

/// By how much noise is now more than was learnt, which is slow: gusts, a touchdown. `freedoms`: of a mean misfit.
double unrestOf(double mean_misfit, double freedoms) {
  return std::max(1.0, mean_misfit / (1.0 + kUnrestSigmas * std::sqrt(2.0 / freedoms)));
}

double median(std::array<double, kMaxMarkers> values, std::size_t count) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(values.begin(), middle, values.begin() + static_cast<std::ptrdiff_t>(count));
  if (count % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

/// Balls' steps, without those that are off the others'.
class StepsOfBalls {
 public:
  void add(const BallStep& ball) {
    x_[count_] = ball.pixels.x();
    y_[count_++] = ball.pixels.y();
  }
  std::size_t count() const { return count_; }
  /// `sigma`: of one ball's step, per axis.
  std::optional<Eigen::Vector2d> mean(double sigma, std::size_t fewest) const {
    const Eigen::Vector2d middle(median(x_, count_), median(y_, count_));
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    std::size_t alike = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      const Eigen::Vector2d step(x_[i], y_[i]);
      if (!((step - middle).cwiseAbs().maxCoeff() < kAlikeSigmas * sigma)) continue;
      sum += step;
      ++alike;
    }
    if (alike < fewest) return std::nullopt;
    return sum / static_cast<double>(alike);
  }

 private:
  std::array<double, kMaxMarkers> x_{}, y_{};
  std::size_t count_ = 0;
};

}  // namespace

void validate(const StepDetectorOptions& options) {
  requirePositive(options.alarm_chi2, "alarm_chi2");
  requirePositive(options.margin_chi2, "margin_chi2");
  requirePositive(options.rest_chi2, "rest_chi2");
  requirePositive(options.floor_px, "floor_px");
  requirePositive(options.smallest_px, "smallest_px");
  requirePositive(options.jerk_m_s3, "jerk_m_s3");
}

StepDetector::StepDetector(const StepDetectorOptions& options) : options_((validate(options), options)) {}

const NamedBalls& StepDetector::Camera::ago(int frames_ago) const {
  return frames[static_cast<std::size_t>((next - 1 - frames_ago + 2 * kKept) % kKept)];
}

void StepDetector::forget(CameraId camera) {
  Camera& forgotten = cameras_[static_cast<std::size_t>(camera.index())];
  forgotten.count = forgotten.next = 0;
  for (Step& step : forgotten.steps) step.known = false;
}

StepDetector::Step StepDetector::measure(const Camera& camera, const Window& window) const {
  Step step;
  const int length = window.before + window.after;
  if (camera.count < length) return step;
  const TimeNs first = camera.ago(length - 1).exposure, last = camera.ago(0).exposure;
  if (last - first > length * kLongestFrame) return step;
  step.time = (camera.ago(window.after).exposure + camera.ago(window.after - 1).exposure) / 2;
  StepsOfBalls steps;
  double variance = 0.0, of_cube = 0.0;
  const double floor = options_.floor_px * options_.floor_px;
  const double noise = camera.noise * (camera.ago(0).variance + floor);
  for (std::size_t m = 0; m < kMaxMarkers; ++m) {
    TrackFit fit;
    std::optional<Eigen::Vector2d> origin;  // nothing is to be lost to large numbers
    for (int f = 0; f < length; ++f) {
      const NamedBalls& frame = camera.ago(f);
      if (!frame.seen[m]) continue;
      const Eigen::Vector2d pixel = frame.pixels[m].cast<double>();
      if (!origin) origin = pixel;
      fit.add(kPerSecond * toSeconds(frame.exposure - step.time), f < window.after, pixel - *origin);
    }
    const auto ball = fit.step(window.before, window.after);
    if (!ball || ball->misfit > kLargestMisfit * noise) continue;
    steps.add(*ball);
    variance += ball->variance;
    of_cube += ball->of_cube;
    step.misfit += ball->misfit / noise;
  }
  if (steps.count() < kFewestBalls) return step;
  const auto balls = static_cast<double>(steps.count());
  const double each = variance / balls * noise;
  const auto pixels = steps.mean(std::sqrt(each + floor), kFewestBalls);
  if (!pixels) return step;
  step.pixels = *pixels;
  step.misfit /= balls;
  step.freedoms = 2.0 * balls * (length - 4);
  step.variance = kChosenLoss * each / balls + floor;
  step.of_jerk_s3 = std::abs(of_cube / balls) / (6.0 * kPerSecond * kPerSecond * kPerSecond);
  step.known = true;
  return step;
}

int StepDetector::add(CameraId id, const NamedBalls& balls, const Eigen::Matrix<double, 2, 3>& d_world) {
  const auto index = static_cast<std::size_t>(id.index());
  Camera& camera = cameras_[index];
  camera.frames[static_cast<std::size_t>(camera.next)] = balls;
  camera.next = (camera.next + 1) % kKept;
  camera.count = std::min(camera.count + 1, kKept);
  camera.d_world = d_world;
  for (std::size_t window = 0; window < kWindows.size(); ++window) {
    camera.steps[window] = measure(camera, kWindows[window]);
    if (!camera.steps[window].known) continue;
    learnNoise(camera, camera.steps[window]);
    if (const int moved = judge(index, window); moved >= 0 && confirmed(moved, balls.exposure)) return moved;
  }
  return -1;
}

void StepDetector::learnNoise(Camera& camera, const Step& step) {
  const double misfit = std::min(step.misfit, kCalmMisfit);
  camera.noise = std::clamp(camera.noise * (1.0 + (misfit - 1.0) / kNoiseFrames), kLeastNoise, kMostNoise);
}

bool StepDetector::confirmed(int suspect, TimeNs now) {
  const bool again = suspect == suspect_ && now - suspected_at_ < kSameTime && suspected_at_ - now < kSameTime;
  suspect_ = again ? -1 : suspect;
  suspected_at_ = now;
  return again;
}

StepDetector::Motion StepDetector::motionOf(std::span<const std::size_t> cameras, std::size_t window,
                                            double prior_m2) const {
  Motion motion;
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity() / prior_m2;
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const std::size_t c : cameras) {
    const Camera& camera = cameras_[c];
    const Step& step = camera.steps[window];
    information.noalias() += camera.d_world.transpose() * camera.d_world / step.variance;
    right.noalias() += camera.d_world.transpose() * step.pixels / step.variance;
    motion.chi2 += step.pixels.squaredNorm() / step.variance;
  }
  motion.covariance = information.inverse();
  motion.shift = motion.covariance * right;
  motion.chi2 -= motion.shift.dot(right);
  return motion;
}

int StepDetector::judge(std::size_t newest, std::size_t window) {
  const TimeNs time = cameras_[newest].steps[window].time;
  std::array<std::size_t, kMaxCameras> together;
  std::size_t count = 0;
  double misfit = 0.0, freedoms = 0.0;
  for (std::size_t c = 0; c < kMaxCameras; ++c) {
    const Step& step = cameras_[c].steps[window];
    if (!step.known || time - step.time >= kSameTime || step.time - time >= kSameTime) continue;
    together[count++] = c;
    misfit += step.misfit;
    freedoms += step.freedoms;
  }
  if (count < kFewestCameras || misfit > kCalmMisfit * static_cast<double>(count)) return -1;
  const std::span<const std::size_t> cameras(together.data(), count);
  // No more than what the largest jerk looks like, and no more than the helicopter usually does.
  const double jerk_m = std::max(kLeastJerkM, options_.jerk_m_s3 * cameras_[newest].steps[window].of_jerk_s3);
  double& usual_m2 = usual_motion_m2_[window];
  if (!(usual_m2 > 0.0)) usual_m2 = jerk_m * jerk_m;
  const double prior_m2 = std::min(jerk_m * jerk_m, kMotionAllowance * usual_m2);
  usual_m2 += (motionOf(cameras, window, jerk_m * jerk_m).shift.squaredNorm() / 3.0 - usual_m2) / kMotionFrames;
  usual_m2 = std::max(usual_m2, kLeastJerkM * kLeastJerkM);
  const Motion motion = motionOf(cameras, window, prior_m2);
  // Every camera more is one more that chance may name.
  const double unrest = unrestOf(misfit / static_cast<double>(count), freedoms);
  const double alarm =
      unrest * (options_.alarm_chi2 + 2.0 * std::log(static_cast<double>(count) / kFewestCameras));
  if (motion.chi2 < alarm) return -1;
  double best = 0.0, second = 0.0;
  std::size_t moved = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Camera& camera = cameras_[together[i]];
    const Step& step = camera.steps[window];
    const Eigen::Vector2d unexplained = (step.pixels - camera.d_world * motion.shift) / step.variance;
    const Eigen::Matrix2d own_information =
        Eigen::Matrix2d::Identity() / step.variance -
        camera.d_world * motion.covariance * camera.d_world.transpose() / (step.variance * step.variance);
    const double explained = unexplained.dot(own_information.inverse() * unexplained);
    if (explained > best) {
      second = best;
      best = explained;
      moved = together[i];
    } else {
      second = std::max(second, explained);
    }
  }
  const double rest = unrest * options_.rest_chi2 * static_cast<double>(count - 1);
  if (best < alarm || best - second < unrest * options_.margin_chi2 || motion.chi2 - best > rest) return -1;
  return cameras_[moved].steps[window].pixels.norm() >= options_.smallest_px ? static_cast<int>(moved) : -1;
}

}  // namespace helical
