#include "engine/calibration/rig_refinement.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/base/check.h"
#include "engine/base/error.h"
#include "engine/calibration/lasting_inflation.h"
#include "engine/calibration/self_calibration_limits.h"

namespace helical {
namespace {

constexpr TimeNs kLag = 40 * kNanosecondsPerMillisecond;  // a moment needs frames after it
// Standard deviations of chi-square, beyond which balls or focal lengths are off and not the images noisy.
constexpr double kBeyondChance = 4.0;
// Over its prior sigma: beyond, the images have hardly added to what is known of a focal length.
constexpr double kOpenFocal = 0.4;
// For balls and focal lengths: one camera by itself sees a helicopter of other balls at another distance.
constexpr int kFewestCameras = 2;
constexpr int kSliceOfAll = 18;  // moments times cameras looked at with one observation

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
      throw Error(ErrorKind::kInput, std::string(key) + " of a refinement is " + std::to_string(value), {}, cure);
  };
  require(options.spacing_s > 0.0 && options.spacing_s <= 60.0, "spacing_s", options.spacing_s,
          "give a time above 0, at most 60 s");
  require(options.fewest_moments >= 3 && options.fewest_moments <= options.moments, "fewest_moments",
          options.fewest_moments, "give 3 to `moments`");
  require(options.moments <= 10000, "moments", options.moments, "give at most 10000");
  require(options.fewest_of_camera >= 3, "fewest_of_camera", options.fewest_of_camera, "give at least 3");
  require(options.good_inliers > 0.0 && options.good_inliers <= 1.0, "good_inliers", options.good_inliers,
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
      start_(cameras.size()),
      markers_(markers),
      flown_(static_cast<std::size_t>(options.moments)),
      jumps_(static_cast<std::size_t>(options.moments)),
      slice_(std::max(1, kSliceOfAll / static_cast<int>(cameras.size()))) {
  focal_scales_.fill(1.0);
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

const char* RigRefinement::start(std::span<const Part> cameras) {
  HELICAL_CHECK(cameras.size() == cameras_);
  if (bundle_.running()) return "the cameras are being refined already";
  const auto moments = store_.frames();
  if (static_cast<int>(moments.size()) < options_.fewest_moments)
    return "too little was seen by two cameras at a time yet";
  bool held = false;
  int unknown = 0, used = 0;
  for (std::size_t c = 0; c < cameras_; ++c) {
    BundleCamera& camera = start_[c];
    camera = {};
    const auto seen = std::count_if(moments.begin(), moments.end(),
                                    [&](const RigMoment* moment) { return moment->views[c].seen.any(); });
    camera.used = cameras[c].used && seen >= options_.fewest_of_camera;
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
  solve(sees_balls ? options_.self : SelfCalibrationOptions{});
  return nullptr;
}

void RigRefinement::solve(const SelfCalibrationOptions& self) {
  solved_count_ = 0;
  for (const RigMoment* moment : store_.frames()) solved_[solved_count_++] = *moment;
  for (std::size_t i = 0; i < solved_count_; ++i) flown_[i] = solved_[i].world_from_body.translation;
  inflation_ =
      lastingInflation({solved_.data(), solved_count_}, options_.lasting_sigma_px, options_.lasting_time_s);
  RigBundleOptions options;
  // The bundle takes pixels for as sure as they are noisy, and they are less: priors weigh as much against them.
  options.marker_sigma_m = self.marker_sigma_m / std::sqrt(inflation_);
  options.focal_sigma = self.focal_sigma / std::sqrt(inflation_);
  correcting_ = self.any();
  bundle_.expect(markers_);
  bundle_.start({solved_.data(), solved_count_}, start_, options);
}

bool RigRefinement::work() {
  if (!bundle_.running() || !bundle_.advance(slice_)) return false;
  if (!correcting_) return true;
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
    solve({});
    return false;
  }
  bundle_.stop();
  return true;
}

bool RigRefinement::leaveOutWhatIsOpen() {
  bool left_out = false;
  auto used = std::count_if(start_.begin(), start_.end(), [](const BundleCamera& camera) { return camera.used; });
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
  if (!succeeded()) return Correction::kUnsound;
  const double n = bundle_.freedoms();
  if (bundle_.gain() <= inflation_ * (n + kBeyondChance * std::sqrt(2.0 * n))) return Correction::kNotNeeded;
  for (std::size_t c = 0; c < cameras_; ++c) {
    const BundleCamera& found = bundle_.cameras()[c];
    if (!found.used) continue;
    if (found.inliers < options_.good_inliers * found.balls) return Correction::kUnsound;
    const double off = std::abs(found.focal_scale - start_[c].focal_scale);
    if (off > options_.farthest_sigmas * options_.self.focal_sigma) return Correction::kUnsound;
  }
  const double farthest_m = options_.farthest_sigmas * options_.self.marker_sigma_m;
  for (int m = 0; m < markers_.count(); ++m) {
    const Eigen::Vector3d off = bundle_.markers().inBody(markerId(m)) - markers_.inBody(markerId(m));
    if (off.cwiseAbs().maxCoeff() > farthest_m) return Correction::kUnsound;
  }
  return medianJump() <= options_.farthest_m ? Correction::kFound : Correction::kUnsound;
}

double RigRefinement::medianJump() {
  for (std::size_t i = 0; i < solved_count_; ++i)
    jumps_[i] = (solved_[i].world_from_body.translation - flown_[i]).norm();
  const auto middle = jumps_.begin() + static_cast<std::ptrdiff_t>(solved_count_ / 2);
  std::nth_element(jumps_.begin(), middle, jumps_.begin() + static_cast<std::ptrdiff_t>(solved_count_));
  return *middle;
}

void RigRefinement::takeCorrection() {
  markers_ = bundle_.markers();
  for (std::size_t c = 0; c < cameras_; ++c)
    if (bundle_.cameras()[c].used) focal_scales_[c] = bundle_.cameras()[c].focal_scale;
}

bool RigRefinement::succeeded() const {
  return bundle_.succeeded() && bundle_.medianSigmas() <= options_.good_median;
}

CameraEstimate RigRefinement::answer(CameraId camera) const {
  const auto index = static_cast<std::size_t>(camera.index());
  CameraEstimate answer;
  if (!succeeded()) return answer;
  const BundleCamera& found = bundle_.cameras()[index];
  const bool exact = start_[index].given && start_[index].covariance.isZero(0.0);
  if (!found.used || exact || found.inliers < options_.good_inliers * found.balls) return answer;
  answer.camera_from_world = found.camera_from_world;
  answer.covariance = inflation_ * found.covariance;
  answer.status = CameraStatus::kCalibrated;
  return answer;
}

}  // namespace helical
