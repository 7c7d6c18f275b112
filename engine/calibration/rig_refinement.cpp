#include "engine/calibration/rig_refinement.h"

#include <algorithm>
#include <string>

#include "engine/base/check.h"
#include "engine/base/error.h"
#include "engine/calibration/lasting_inflation.h"

namespace helical {
namespace {

constexpr TimeNs kLag = 40 * kNanosecondsPerMillisecond;  // a moment needs frames after it
constexpr int kSliceOfAll = 18;  // moments times cameras looked at with one observation

}  // namespace

void validate(const RigRefinementOptions& options) {
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
      slice_(std::max(1, kSliceOfAll / static_cast<int>(cameras.size()))) {}

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
  int unknown = 0;
  for (std::size_t c = 0; c < cameras_; ++c) {
    BundleCamera& camera = start_[c];
    camera = {};
    const auto seen = std::count_if(moments.begin(), moments.end(),
                                    [&](const RigMoment* moment) { return moment->views[c].seen.any(); });
    camera.used = cameras[c].used && seen >= options_.fewest_of_camera;
    camera.given = cameras[c].holds;
    camera.camera_from_world = cameras[c].estimate.camera_from_world;
    camera.covariance = cameras[c].estimate.covariance;
    held = held || (camera.used && camera.given);
    unknown += camera.used && !(camera.given && camera.covariance.isZero(0.0));
  }
  if (!held) return "no camera is known that the others could be placed by";
  if (unknown == 0) return "every camera's pose is given exactly, or it saw too little";
  solved_count_ = 0;
  for (const RigMoment* moment : moments) solved_[solved_count_++] = *moment;
  bundle_.start({solved_.data(), solved_count_}, start_, {});
  return nullptr;
}

bool RigRefinement::work() {
  return bundle_.running() && bundle_.advance(slice_);
}

CameraEstimate RigRefinement::answer(CameraId camera) const {
  const auto index = static_cast<std::size_t>(camera.index());
  CameraEstimate answer;
  if (!bundle_.succeeded() || bundle_.medianSigmas() > options_.good_median) return answer;
  const BundleCamera& found = bundle_.cameras()[index];
  const bool exact = start_[index].given && start_[index].covariance.isZero(0.0);
  if (!found.used || exact || found.inliers < options_.good_inliers * found.balls) return answer;
  answer.camera_from_world = found.camera_from_world;
  answer.covariance = lastingInflation({solved_.data(), solved_count_}, options_.lasting_sigma_px,
                                       options_.lasting_time_s) *
                      found.covariance;
  answer.status = CameraStatus::kCalibrated;
  return answer;
}

}  // namespace helical
