#include "engine/calibration/step_detector.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <optional>

#include "engine/base/require.h"

namespace helical {
namespace {

constexpr TimeNs kSameTime = 25 * kNanosecondsPerMillisecond;
constexpr TimeNs kLongestFrame = 40 * kNanosecondsPerMillisecond;  // on average over a track
constexpr int kFewestBalls = 3;
constexpr int kFewestCameras = 3;
constexpr double kPerSecond = 10.0;  // unit of time of the fit: its matrix is well scaled
constexpr double kLargestMisfit = 2.5;  // over a centroid's variance: one false centroid among them is more
// On average over all cameras: more is a jolt of the helicopter, which no parabola follows.
constexpr double kCalmMisfit = 1.4;
constexpr double kMedianLoss = 1.3;  // variance of the median of a few over that of their mean

struct BallStep {
  Eigen::Vector2d pixels;
  double variance = 0.0;  ///< over that of a centroid
  double misfit = 0.0;    ///< variance of what is left, per axis [px^2]
};

/// Least squares of a parabola and a step along one ball's track.
class TrackFit {
 public:
  void add(double time, bool after, const Eigen::Vector2d& pixel) {
    const Eigen::Vector4d row(1.0, time, time * time, after ? 0.5 : -0.5);
    normal_.noalias() += row * row.transpose();
    right_.noalias() += row * pixel.transpose();
    squares_ += pixel.squaredNorm();
    ++count_[after];
  }
  std::optional<BallStep> step(int fewest) const {
    if (count_[0] < fewest || count_[1] < fewest) return std::nullopt;
    const Eigen::LDLT<Eigen::Matrix4d> factor(normal_);
    const Eigen::Vector4d column = factor.solve(Eigen::Vector4d::UnitW());
    if (!column.allFinite() || !(column[3] > 0.0)) return std::nullopt;
    const Eigen::Matrix<double, 4, 2> solution = factor.solve(right_);
    const double left = squares_ - solution.cwiseProduct(right_).sum();
    return BallStep{right_.transpose() * column, column[3], left / (2.0 * (count_[0] + count_[1] - 4))};
  }

 private:
  Eigen::Matrix4d normal_ = Eigen::Matrix4d::Zero();
  Eigen::Matrix<double, 4, 2> right_ = Eigen::Matrix<double, 4, 2>::Zero();
  double squares_ = 0.0;
  std::array<int, 2> count_{};
};

double median(std::array<double, kMaxMarkers>& values, std::size_t count) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(values.begin(), middle, values.begin() + static_cast<std::ptrdiff_t>(count));
  if (count % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

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

StepDetector::Step StepDetector::measure(const Camera& camera, int side) const {
  Step step;
  if (camera.count < 2 * side) return step;
  const TimeNs first = camera.ago(2 * side - 1).exposure, last = camera.ago(0).exposure;
  if (last - first > 2 * side * kLongestFrame) return step;
  step.time = (camera.ago(side).exposure + camera.ago(side - 1).exposure) / 2;
  std::array<double, kMaxMarkers> x, y;
  std::size_t balls = 0;
  double variance = 0.0;
  const double floor = options_.floor_px * options_.floor_px;
  for (std::size_t m = 0; m < kMaxMarkers; ++m) {
    TrackFit fit;
    std::optional<Eigen::Vector2d> origin;  // nothing is to be lost to large numbers
    for (int f = 0; f < 2 * side; ++f) {
      const NamedBalls& frame = camera.ago(f);
      if (!frame.seen[m]) continue;
      const Eigen::Vector2d pixel = frame.pixels[m].cast<double>();
      if (!origin) origin = pixel;
      fit.add(kPerSecond * toSeconds(frame.exposure - step.time), f < side, pixel - *origin);
    }
    const auto ball = fit.step(side - 1);
    if (!ball || ball->misfit > kLargestMisfit * (camera.ago(0).variance + floor)) continue;
    x[balls] = ball->pixels.x();
    y[balls++] = ball->pixels.y();
    variance += ball->variance;
    step.misfit += ball->misfit / (camera.ago(0).variance + floor);
  }
  if (balls < kFewestBalls) return step;
  const double each = variance / static_cast<double>(balls) * camera.ago(0).variance;
  step.misfit /= static_cast<double>(balls);
  step.pixels = {median(x, balls), median(y, balls)};
  step.variance = kMedianLoss * each / static_cast<double>(balls) + floor;
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
  for (std::size_t scale = 0; scale < kSides.size(); ++scale) {
    camera.steps[scale] = measure(camera, kSides[scale]);
    if (!camera.steps[scale].known) continue;
    if (const int moved = judge(index, scale); moved >= 0 && confirmed(moved, balls.exposure)) return moved;
  }
  return -1;
}

bool StepDetector::confirmed(int suspect, TimeNs now) {
  const bool again = suspect == suspect_ && now - suspected_at_ < kSameTime && suspected_at_ - now < kSameTime;
  suspect_ = again ? -1 : suspect;
  suspected_at_ = now;
  return again;
}

int StepDetector::judge(std::size_t newest, std::size_t scale) const {
  const TimeNs time = cameras_[newest].steps[scale].time;
  std::array<std::size_t, kMaxCameras> together;
  std::size_t count = 0;
  for (std::size_t c = 0; c < kMaxCameras; ++c) {
    const Step& step = cameras_[c].steps[scale];
    if (step.known && time - step.time < kSameTime && step.time - time < kSameTime) together[count++] = c;
  }
  if (count < kFewestCameras) return -1;
  // A constant jerk over T before and after the middle looks like a step of jerk T^3 / 30.
  const Camera& own = cameras_[newest];
  const double side_s = 0.5 * toSeconds(own.ago(0).exposure - own.ago(2 * kSides[scale] - 1).exposure);
  const double jerk_m = options_.jerk_m_s3 * side_s * side_s * side_s / 30.0;
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity() / (jerk_m * jerk_m);
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double chi2 = 0.0, misfit = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Camera& camera = cameras_[together[i]];
    const Step& step = camera.steps[scale];
    misfit += step.misfit / static_cast<double>(count);
    information.noalias() += camera.d_world.transpose() * camera.d_world / step.variance;
    right.noalias() += camera.d_world.transpose() * step.pixels / step.variance;
    chi2 += step.pixels.squaredNorm() / step.variance;
  }
  const Eigen::Matrix3d covariance = information.inverse();
  const Eigen::Vector3d shift = covariance * right;
  chi2 -= shift.dot(right);
  if (chi2 < options_.alarm_chi2 || misfit > kCalmMisfit) return -1;
  double best = 0.0, second = 0.0;
  std::size_t moved = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Camera& camera = cameras_[together[i]];
    const Step& step = camera.steps[scale];
    const Eigen::Vector2d unexplained = (step.pixels - camera.d_world * shift) / step.variance;
    const Eigen::Matrix2d own_information =
        Eigen::Matrix2d::Identity() / step.variance -
        camera.d_world * covariance * camera.d_world.transpose() / (step.variance * step.variance);
    const double explained = unexplained.dot(own_information.inverse() * unexplained);
    if (explained > best) {
      second = best;
      best = explained;
      moved = together[i];
    } else {
      second = std::max(second, explained);
    }
  }
  const double rest = options_.rest_chi2 * static_cast<double>(count - 1);
  if (best < options_.alarm_chi2 || best - second < options_.margin_chi2 || chi2 - best > rest) return -1;
  return cameras_[moved].steps[scale].pixels.norm() >= options_.smallest_px ? static_cast<int>(moved) : -1;
}

}  // namespace helical
