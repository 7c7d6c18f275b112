#include "engine/calibration/rig_refinement.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <string>

#include "engine/base/check.h"
#include "engine/base/error.h"
#include "engine/calibration/lasting_inflation.h"
#include "engine/calibration/self_calibration_limits.h"
#include "engine/geometry/rotation.h"

namespace helical {
namespace {

constexpr TimeNs kLag = 40 * kNanosecondsPerMillisecond;  // a moment needs frames after it
// Standard deviations of chi-square, beyond which balls or focal lengths are off and not the images noisy.
constexpr double kBeyondChance = 4.0;
// Over its prior sigma: beyond, the images have hardly added to what is known of a focal length.
constexpr double kOpenFocal = 0.4;
// For balls and focal lengths: one camera by itself sees a helicopter of other balls at another distance.
constexpr int kFewestCameras = 2;
constexpr double kHardlySeen = 0.25;  // over the images of the ball that was seen most
constexpr int kSliceOfAll = 18;  // moments times cameras looked at with one observation

/// That chi-square passes as rarely as a normal deviate passes `sigmas` (Wilson and Hilferty).
double chi2Beyond(double sigmas, double freedoms) {
  const double spread = 2.0 / (9.0 * freedoms);
  return freedoms * std::pow(1.0 - spread + sigmas * std::sqrt(spread), 3);
}

/// Of three balls nothing is left across their plane, where the solution ends some hundredths beside the prior.
constexpr double kLeastLeft = 0.1;

/// Balls may shift and turn as a whole, and no image shows it: one that is far off is found as a bit of it in
/// each.
class RigidFreedoms {
 public:
  explicit RigidFreedoms(const MarkerLayout& layout) {
    for (const Eigen::Vector3d& ball : layout.all()) centre_ += ball / layout.count();
    Matrix6d sum = Matrix6d::Zero();
    for (const Eigen::Vector3d& ball : layout.all()) sum.noalias() += motion(ball).transpose() * motion(ball);
    inverse_ =
        sum.completeOrthogonalDecomposition().pseudoInverse();  // balls in one line turn about it freely
  }
  /// Share of its standard deviation that a ball keeps once they have shifted and turned to the nearest, per
  /// axis.
  Eigen::Vector3d left(const Eigen::Vector3d& ball) const {
    const Eigen::Matrix3d taken = motion(ball) * inverse_ * motion(ball).transpose();
    return (Eigen::Vector3d::Ones() - taken.diagonal()).cwiseMax(kLeastLeft * kLeastLeft).cwiseSqrt();
  }

 private:
  Eigen::Matrix<double, 3, 6> motion(const Eigen::Vector3d& ball) const {
    Eigen::Matrix<double, 3, 6> motion;
    motion << Eigen::Matrix3d::Identity(), -hat(ball - centre_);
    return motion;
  }
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();
  Matrix6d inverse_;
};

}  // namespace

void validate(const SelfCalibrationOptions& options) {
  const auto require = [](double value, double most, const char* key) {
    if (!(value >= 0.0 && value <= most))
      throw Error(ErrorKind::kInput, std::string(key) + " is " + std::to_string(value), {},
                  "give 0 (it is as the rig says) to " + std::to_string(most));
  };
  require(options.marker_sigma_m, kMostMarkerSigmaM, "marker_sigma_m");
  require(options.focal_sigma, kMostFocalSigma, "focal_sigma");
}

void validate(const RigRefinementOptions& options) {
  validate(options.self);
  const auto require = [](bool good, const char* key, double value, const char* cure) {
    if (!good)
      throw Error(ErrorKind::kInput, std::string(key) + " of a refinement is " + std::to_string(value), {},
                  cure);
  };
  require(options.spacing_s > 0.0 && options.spacing_s <= 60.0, "spacing_s", options.spacing_s,
          "give a time above 0, at most 60 s");
  require(options.fewest_moments >= 3 && options.fewest_moments <= options.moments, "fewest_moments",
          options.fewest_moments, "give 3 to `moments`");
  require(options.moments <= 10000, "moments", options.moments, "give at most 10000");
  require(options.fewest_of_camera >= 3, "fewest_of_camera", options.fewest_of_camera, "give at least 3");
  require(options.good_inliers > 0.0 && options.good_inliers <= 1.0, "good_inliers", options.good_inliers,
          "give a share above 0");
  require(options.good_ball > 0.0 && options.good_ball <= 1.0, "good_ball", options.good_ball,
          "give a share above 0");
  require(options.good_median > 1.2, "good_median", options.good_median, "give more than 1.2");
}

RigRefinement::RigRefinement(const std::vector<CameraModel>& cameras, const MarkerLayout& markers,
                             const RigRefinementOptions& options)
    : options_((validate(options), options)),
      cameras_(cameras.size()),
      store_(options.moments),
      solved_(static_cast<std::size_t>(options.moments)),
      bundle_(cameras, markers, options.moments),
      asked_(cameras.size()),
      start_(cameras.size()),
      markers_(markers),
      said_markers_(markers),
      flown_(static_cast<std::size_t>(options.moments)),
      jumps_(static_cast<std::size_t>(options.moments)),
      slice_(std::max(1, kSliceOfAll / static_cast<int>(cameras.size()))) {
  focal_scales_.fill(1.0);
  said_scales_.fill(1.0);
}

void RigRefinement::see(CameraId camera, const NamedBalls& balls, const RigidTransform& world_from_body) {
  maker_.add(camera, balls);
  if (toSeconds(balls.exposure - last_kept_) >= options_.spacing_s) keep(balls.exposure, world_from_body);
}

void RigRefinement::keep(TimeNs now, const RigidTransform& world_from_body) {
  if (maker_.at(now - kLag, moment_) < 2) return;
  moment_.world_from_body = world_from_body;
  store_.add(moment_);
  last_kept_ = now;
}

void RigRefinement::forget(CameraId camera) {
  const auto index = static_cast<std::size_t>(camera.index());
  maker_.forget();
  store_.forEach([&](RigMoment& moment) { moment.views[index].seen.reset(); });
  bundle_.stop();
}

void RigRefinement::startAfresh() {
  maker_.forget();
  store_.clear();
}

const char* RigRefinement::start(std::span<const Part> cameras) {
  HELICAL_CHECK(cameras.size() == cameras_);
  if (bundle_.running()) return "the cameras are being refined already";
  const auto moments = store_.frames();
  if (static_cast<int>(moments.size()) < options_.fewest_moments)
    return "too little was seen by two cameras at a time yet";
  bool held = false;
  int unknown = 0, used = 0;
  for (std::size_t c = 0; c < cameras_; ++c) {
    BundleCamera& camera = asked_[c];
    camera = {};
    const auto seen = std::count_if(moments.begin(), moments.end(),
                                    [&](const RigMoment* moment) { return moment->views[c].seen.any(); });
    camera.used = cameras[c].used && seen >= options_.fewest_of_camera;
    in_control_[c] = camera.used && !cameras[c].frozen && !cameras[c].hidden &&
                     cameras[c].estimate.status == CameraStatus::kCalibrated;
    camera.given = cameras[c].holds;
    camera.camera_from_world = cameras[c].estimate.camera_from_world;
    camera.covariance = cameras[c].estimate.covariance;
    camera.focal_is_given = cameras[c].frozen;
    camera.focal_scale = focal_scales_[c];
    used += camera.used;
    held = held || (camera.used && camera.given);
    unknown += camera.used && !(camera.given && camera.covariance.isZero(0.0));
  }
  if (!held) return "no camera is known that the others could be placed by";
  other_unknowns_ = unknown > 0;
  const bool sees_balls = options_.self.any() && used >= kFewestCameras;
  if (!other_unknowns_ && !sees_balls) return "every camera's pose is given exactly, or it saw too little";
  correction_ = Correction::kNotSought;
  start_ = asked_;
  solve(sees_balls ? options_.self : SelfCalibrationOptions{});
  return nullptr;
}

void RigRefinement::solve(const SelfCalibrationOptions& self) {
  solved_count_ = 0;
  for (const RigMoment* moment : store_.frames()) solved_[solved_count_++] = *moment;
  for (std::size_t i = 0; i < solved_count_; ++i) flown_[i] = solved_[i].world_from_body;
  inflation_ =
      lastingInflation({solved_.data(), solved_count_}, options_.lasting_sigma_px, options_.lasting_time_s);
  RigBundleOptions options;
  // The bundle takes pixels for as sure as they are noisy, and they are less: priors weigh as much against
  // them.
  options.marker_sigma_m = self.marker_sigma_m / std::sqrt(inflation_);
  options.focal_sigma = self.focal_sigma / std::sqrt(inflation_);
  correcting_ = self.any();
  bundle_.expect(self.marker_sigma_m > 0.0 ? said_markers_ : markers_);
  for (std::size_t c = 0; c < cameras_; ++c)
    start_[c].focal_scale =
        self.focal_sigma > 0.0 && !start_[c].focal_is_given ? said_scales_[c] : focal_scales_[c];
  bundle_.start({solved_.data(), solved_count_}, start_, options);
}

bool RigRefinement::work() {
  if (!bundle_.running() || !bundle_.advance(slice_)) return false;
  if (!correcting_) {
    if (!succeeded())
      correction_ = Correction::kNoAnswer;
    else if (poseJumpsTooFar() || someCameraJumpsTooFar())
      correction_ = Correction::kCamerasTooFar;
    else if (correction_ == Correction::kNoAnswer)
      correction_ = Correction::kUnsound;  // for the cameras alone there is one
    return true;
  }
  if (succeeded() && leaveOutWhatIsOpen()) {
    solve(options_.self);
    return false;
  }
  correction_ = judgeCorrection();
  if (correction_ == Correction::kFound) {
    takeCorrection();
    return true;
  }
  if (other_unknowns_) {
    start_ = asked_;
    solve({});
    return false;
  }
  bundle_.stop();
  return true;
}

bool RigRefinement::leaveOutWhatIsOpen() {
  bool left_out = false;
  auto used =
      std::count_if(start_.begin(), start_.end(), [](const BundleCamera& camera) { return camera.used; });
  for (std::size_t c = 0; c < cameras_; ++c) {
    BundleCamera& camera = start_[c];
    if (!camera.used) continue;
    const BundleCamera& found = bundle_.cameras()[c];
    if (!camera.given && used > kFewestCameras && found.inliers < options_.good_inliers * found.balls) {
      camera.used = false;
      --used;
      left_out = true;
    } else if (!camera.focal_is_given &&
               std::sqrt(inflation_) * found.focal_sigma > kOpenFocal * options_.self.focal_sigma) {
      camera.focal_is_given = left_out = true;
    }
  }
  return left_out;
}

RigRefinement::Correction RigRefinement::judgeCorrection() {
  if (!bundle_.succeeded()) return Correction::kNoAnswer;
  // A ball that is far off weighs nothing, and without it all is well.
  if (!succeeded() || !everyBallFits()) return Correction::kUnsound;
  const double n = bundle_.freedoms();
  // What was found by as many images errs as much as what is found now.
  const double variance = inflation_ * (found_before_ ? 2.0 : 1.0);
  if (bundle_.gainOver(markers_, focal_scales_) <= variance * (n + kBeyondChance * std::sqrt(2.0 * n)))
    return Correction::kNotNeeded;
  for (std::size_t c = 0; c < cameras_; ++c) {
    const BundleCamera& found = bundle_.cameras()[c];
    if (!found.used) continue;
    if (found.inliers < options_.good_inliers * found.balls) return Correction::kUnsound;
  }
  if (!isWithinPriors()) return Correction::kUnsound;
  return poseJumpsTooFar() ? Correction::kTooFar : Correction::kFound;
}

bool RigRefinement::everyBallFits() const {
  for (int m = 0; m < markers_.count(); ++m)
    if (bundle_.fitting(markerId(m)) < options_.good_ball) return false;
  return true;
}

int RigRefinement::ballsHardlySeen() const {
  std::array<int, kMaxMarkers> seen{};
  for (std::size_t i = 0; i < solved_count_; ++i)
    for (std::size_t c = 0; c < cameras_; ++c)
      for (int m = 0; m < markers_.count(); ++m)
        seen[static_cast<std::size_t>(m)] +=
            asked_[c].used && solved_[i].views[c].seen[static_cast<std::size_t>(m)];
  const auto balls = std::span(seen).first(static_cast<std::size_t>(markers_.count()));
  const double fewest = kHardlySeen * std::ranges::max(balls);
  return static_cast<int>(std::ranges::count_if(balls, [&](int count) { return count < fewest; }));
}

bool RigRefinement::isWithinPriors() const {
  double chi2 = 0.0;
  const SelfCalibrationOptions& self = options_.self;
  for (std::size_t c = 0; c < cameras_; ++c) {
    const BundleCamera& found = bundle_.cameras()[c];
    if (!found.used || start_[c].focal_is_given || !(self.focal_sigma > 0.0)) continue;
    const double off = (found.focal_scale - said_scales_[c]) / self.focal_sigma;
    if (std::abs(off) > options_.farthest_sigmas) return false;
    chi2 += off * off;
  }
  if (self.marker_sigma_m > 0.0) {
    const RigidFreedoms rigid(said_markers_);
    for (int m = 0; m < markers_.count(); ++m) {
      const Eigen::Vector3d& said = said_markers_.inBody(markerId(m));
      const Eigen::Vector3d off = (bundle_.markers().inBody(markerId(m)) - said) / self.marker_sigma_m;
      const Eigen::Vector3d allowed = options_.farthest_sigmas * rigid.left(said);
      if ((off.cwiseAbs().array() > allowed.array()).any()) return false;
      chi2 += off.squaredNorm();
    }
  }
  return chi2 <= chi2Beyond(options_.farthest_sigmas, bundle_.freedoms());
}

template <typename PoseAfter>
bool RigRefinement::jumpsTooFar(const PoseAfter& pose_after) {
  const auto median = [this] {
    const auto middle = jumps_.begin() + static_cast<std::ptrdiff_t>(solved_count_ / 2);
    std::nth_element(jumps_.begin(), middle, jumps_.begin() + static_cast<std::ptrdiff_t>(solved_count_));
    return *middle;
  };
  for (std::size_t i = 0; i < solved_count_; ++i)
    jumps_[i] = (pose_after(i).translation - flown_[i].translation).norm();
  if (median() > options_.farthest_m) return true;
  for (std::size_t i = 0; i < solved_count_; ++i)
    jumps_[i] = pose_after(i).rotation.angularDistance(flown_[i].rotation);
  return median() > options_.farthest_rad;
}

bool RigRefinement::poseJumpsTooFar() {
  return jumpsTooFar([this](std::size_t i) -> const RigidTransform& { return solved_[i].world_from_body; });
}

bool RigRefinement::someCameraJumpsTooFar() {
  for (std::size_t c = 0; c < cameras_; ++c) {
    const BundleCamera& found = bundle_.cameras()[c];
    if (!in_control_[c] || !hasAnswer(c)) continue;
    const RigidTransform moved = found.camera_from_world.inverse() * asked_[c].camera_from_world;
    if (jumpsTooFar([&](std::size_t i) { return moved * flown_[i]; })) return true;
  }
  return false;
}

void RigRefinement::takeCorrection() {
  found_before_ = true;
  markers_ = bundle_.markers();
  for (std::size_t c = 0; c < cameras_; ++c)
    if (bundle_.cameras()[c].used) focal_scales_[c] = bundle_.cameras()[c].focal_scale;
}

bool RigRefinement::succeeded() const {
  return bundle_.succeeded() && bundle_.medianSigmas() <= options_.good_median;
}

bool RigRefinement::hasAnswer(std::size_t camera) const {
  const BundleCamera& found = bundle_.cameras()[camera];
  const bool exact = start_[camera].given && start_[camera].covariance.isZero(0.0);
  return found.used && !exact && found.inliers >= options_.good_inliers * found.balls;
}

CameraEstimate RigRefinement::answer(CameraId camera) const {
  const auto index = static_cast<std::size_t>(camera.index());
  CameraEstimate answer;
  if (!succeeded() || correction_ == Correction::kCamerasTooFar) return answer;
  if (!hasAnswer(index)) return answer;
  const BundleCamera& found = bundle_.cameras()[index];
  answer.camera_from_world = found.camera_from_world;
  answer.covariance = inflation_ * found.covariance;
  answer.status = CameraStatus::kCalibrated;
  return answer;
}

}  // namespace helical
