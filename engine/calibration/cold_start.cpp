#include "engine/calibration/cold_start.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/calibration/admission.h"
#include "engine/calibration/lasting_inflation.h"
#include "engine/calibration/thinned_store.h"

namespace helical {
namespace {

constexpr double kStillPx = 0.6, kStillSigmas = 4.0;  // a ball that does not move stays as near to its mean
constexpr TimeNs kStillGap = 200 * kNanosecondsPerMillisecond;
constexpr TimeNs kPadSpacing = 250 * kNanosecondsPerMillisecond;
// A moment needs frames after it; on the pad also the certainty that it still stood then.
constexpr TimeNs kWaveLag = 40 * kNanosecondsPerMillisecond, kPadLag = 150 * kNanosecondsPerMillisecond;
constexpr TimeNs kSolvePeriod = 2 * kNanosecondsPerSecond;
constexpr int kWorthSolving = 8;        // moments since the last solution
constexpr int kFewestPadMoments = 3;
constexpr int kFewestMomentsOfCamera = 12;
constexpr int kSliceOfAll = 18;         // moments times cameras looked at with one observation
constexpr double kReachM = 0.2;         // around where a camera saw it on average, it has to be good

std::size_t indexOf(CameraId camera) {
  return static_cast<std::size_t>(camera.index());
}

}  // namespace

ColdStart::ColdStart(const std::vector<CameraModel>& cameras, const MarkerLayout& markers, double standing_height,
                     std::span<const CameraEstimate> given, const ColdStartOptions& options)
    : models_(cameras),
      markers_(markers),
      options_(options),
      moments_(kStored),
      seen_(kStored),
      bundle_(cameras, markers, kStored),
      start_(cameras.size()),
      given_(given.begin(), given.end()),
      answer_(cameras.size()),
      still_(cameras.size()),
      spacing_m_(options.spacing_m),
      slice_(std::max(1, kSliceOfAll / static_cast<int>(cameras.size()))) {
  on_pad_.translation.z() = standing_height;
  for (const CameraModel& camera : models_) views_.push_back(std::make_unique<BodyView>(camera, markers));
  for (std::size_t c = 0; c < given_.size(); ++c) {
    if (given_[c].status != CameraStatus::kCalibrated) continue;
    answer_[c] = given_[c];
    world_is_given_ = true;
    stage_ = Stage::kWave;
  }
}

const char* ColdStart::instruction() const {
  switch (stage_) {
    case Stage::kStand:
      return "Stand it on the pad, nose along x, before the cameras";
    case Stage::kWave:
      return "Carry it through the space that all cameras see";
    case Stage::kSolved:
      return "Cameras found: put it back on the pad";
  }
  return "";
}

bool ColdStart::takeAnswer() {
  const bool fresh = fresh_answer_;
  fresh_answer_ = false;
  return fresh;
}

void ColdStart::step(const Observation& observation) {
  const std::size_t camera = indexOf(observation.camera);
  BodyView& view = *views_[camera];
  view.step(observation);
  if (view.known()) {
    NamedBalls balls;
    balls.exposure = observation.exposure;
    balls.seen = view.seen();
    for (std::size_t m = 0; m < kMaxMarkers; ++m) balls.pixels[m] = view.pixels()[m].cast<float>();
    balls.variance = static_cast<float>(view.variance());
    balls.camera_from_body = view.cameraFromBody();
    maker_.add(observation.camera, balls);
    if (stage_ == Stage::kStand) watchStanding(camera, observation.exposure);
  }
  if (bundle_.running()) {
    if (bundle_.advance(slice_)) judge();
    return;
  }
  collect(observation.exposure);
}

void ColdStart::watchStanding(std::size_t camera, TimeNs now) {
  const BodyView& view = *views_[camera];
  Still& still = still_[camera];
  const double limit = kStillPx + kStillSigmas * std::sqrt(view.variance());
  bool moved = !still.known || now - still.last > kStillGap;
  for (std::size_t m = 0; m < kMaxMarkers && !moved; ++m)
    moved = view.seen()[m] && (view.pixels()[m] - still.pixels[m]).norm() > limit;
  still.last = now;
  if (moved) {
    still.known = view.seen().count() == static_cast<std::size_t>(markers_.count());
    still.since = now;
    still.frames = 1.0;
    for (std::size_t m = 0; m < kMaxMarkers; ++m) still.pixels[m] = view.pixels()[m];
    return;
  }
  still.frames += 1.0;
  for (std::size_t m = 0; m < kMaxMarkers; ++m)
    if (view.seen()[m]) still.pixels[m] += (view.pixels()[m] - still.pixels[m]) / still.frames;
}

void ColdStart::collect(TimeNs now) {
  if (stage_ == Stage::kStand) {
    int standing = 0, moving = 0;
    for (std::size_t c = 0; c < still_.size(); ++c) {
      if (!still_[c].known || now - still_[c].last > kStillGap) continue;
      const bool long_enough = toSeconds(now - still_[c].since) >= options_.stand_s;
      (long_enough ? standing : moving)++;
    }
    if (standing >= 1 && moving == 0) {
      if (now - last_moment_ >= kPadSpacing && pad_count_ < kMaxPadMoments) keep(now - kPadLag, true);
    } else if (moving > 0 && pad_count_ > 0) {
      if (pad_count_ < kFewestPadMoments) {
        pad_count_ = count_ = 0;  // it was not put down yet
      } else {
        stage_ = Stage::kWave;
      }
    }
    return;
  }
  if (toSeconds(now - last_moment_) >= options_.spacing_s) keep(now - kWaveLag, false);
  const int waving = count_ - pad_count_;
  const bool first = stage_ == Stage::kWave && waving >= options_.first_moments && since_solved_ >= kWorthSolving;
  const bool again = now - last_solved_ >= kSolvePeriod && since_solved_ >= kWorthSolving && waving >= options_.first_moments;
  if (first || again) startSolving(now);
}

bool ColdStart::keep(TimeNs time, bool on_pad) {
  if (count_ == kStored) thin();
  std::array<const NamedBalls*, kMaxCameras> nearest{};
  RigMoment& moment = moments_[static_cast<std::size_t>(count_)];
  const int cameras = maker_.at(time, moment, &nearest);
  if (cameras < (on_pad ? 1 : 2)) return false;
  if (!on_pad && last_camera_ >= 0) {
    const NamedBalls* same = nearest[static_cast<std::size_t>(last_camera_)];
    if (same != nullptr && poseDistance(same->camera_from_body, last_seen_) < spacing_m_) return false;
  }
  Seen& seen = seen_[static_cast<std::size_t>(count_)];
  seen.has.reset();
  last_camera_ = -1;
  for (std::size_t c = 0; c < models_.size(); ++c) {
    if (nearest[c] == nullptr) continue;
    seen.has.set(c);
    seen.camera_from_body[c] = nearest[c]->camera_from_body;
    if (last_camera_ >= 0) continue;
    last_camera_ = static_cast<int>(c);
    last_seen_ = nearest[c]->camera_from_body;
  }
  moment.pose_is_given = on_pad;
  moment.world_from_body = on_pad_;
  last_moment_ = time + (on_pad ? kPadLag : kWaveLag);
  ++count_;
  if (on_pad) ++pad_count_;
  if (!on_pad) ++since_solved_;
  return true;
}

/// Every second one of those not on the pad makes room, and new ones have to be farther apart.
void ColdStart::thin() {
  int kept = pad_count_;
  for (int i = pad_count_; i < count_; i += 2, ++kept) {
    moments_[static_cast<std::size_t>(kept)] = moments_[static_cast<std::size_t>(i)];
    seen_[static_cast<std::size_t>(kept)] = seen_[static_cast<std::size_t>(i)];
  }
  count_ = kept;
  spacing_m_ *= 1.5;
}

void ColdStart::startSolving(TimeNs now) {
  last_solved_ = now;
  since_solved_ = 0;
  for (std::size_t c = 0; c < models_.size(); ++c) {
    BundleCamera& camera = start_[c];
    camera = {};
    camera.given = given_[c].status == CameraStatus::kCalibrated;
    camera.covariance = given_[c].covariance;
    camera.used = camera.given || answer_[c].status == CameraStatus::kCalibrated;
    camera.camera_from_world = camera.given ? given_[c].camera_from_world : answer_[c].camera_from_world;
  }
  if (!placeCameras() || !placeMoments()) return;
  bundle_.start({moments_.data(), static_cast<std::size_t>(count_)}, start_, {});
}

/// Cameras that are not placed yet: by how they saw the helicopter on the pad, or when a placed one saw it, too.
bool ColdStart::placeCameras() {
  const auto place = [&](std::size_t c, const RigidTransform& camera_from_world) {
    start_[c].used = true;
    start_[c].camera_from_world = camera_from_world;
  };
  for (int i = 0; i < pad_count_; ++i) {
    const Seen& seen = seen_[static_cast<std::size_t>(i)];
    for (std::size_t c = 0; c < models_.size(); ++c)
      if (!start_[c].used && seen.has[c]) place(c, seen.camera_from_body[c] * on_pad_.inverse());
  }
  std::array<int, kMaxCameras> times{};
  for (int i = 0; i < count_; ++i)
    for (std::size_t c = 0; c < models_.size(); ++c) times[c] += seen_[static_cast<std::size_t>(i)].has[c];
  for (bool found = true; found;) {
    found = false;
    for (int i = pad_count_; i < count_; ++i) {
      const Seen& seen = seen_[static_cast<std::size_t>(i)];
      for (std::size_t known = 0; known < models_.size(); ++known) {
        if (!seen.has[known] || !start_[known].used) continue;
        const RigidTransform body_from_world =
            seen.camera_from_body[known].inverse() * start_[known].camera_from_world;
        for (std::size_t c = 0; c < models_.size(); ++c) {
          if (start_[c].used || !seen.has[c]) continue;
          place(c, seen.camera_from_body[c] * body_from_world);
          found = true;
        }
      }
    }
  }
  int used = 0;
  for (std::size_t c = 0; c < models_.size(); ++c) {
    start_[c].used = start_[c].used && (start_[c].given || times[c] >= kFewestMomentsOfCamera);
    used += start_[c].used;
  }
  return used >= 2;
}

bool ColdStart::placeMoments() {
  int placed = 0;
  for (int i = pad_count_; i < count_; ++i) {
    const Seen& seen = seen_[static_cast<std::size_t>(i)];
    for (std::size_t c = 0; c < models_.size(); ++c) {
      if (!start_[c].used || !seen.has[c]) continue;
      moments_[static_cast<std::size_t>(i)].world_from_body =
          start_[c].camera_from_world.inverse() * seen.camera_from_body[c];
      ++placed;
      break;
    }
  }
  return placed >= options_.first_moments / 2;
}

/// What that camera saw was not the helicopter, or named wrongly: it begins anew.
void ColdStart::drop(std::size_t camera) {
  views_[camera]->forget();
  for (int i = 0; i < count_; ++i) {
    moments_[static_cast<std::size_t>(i)].views[camera].seen.reset();
    seen_[static_cast<std::size_t>(i)].has.reset(camera);
  }
  if (given_[camera].status != CameraStatus::kCalibrated) answer_[camera] = {};
}

Eigen::Vector3d ColdStart::whereSeen(std::size_t camera) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0.0;
  for (int i = pad_count_; i < count_; ++i) {
    const RigMoment& moment = moments_[static_cast<std::size_t>(i)];
    if (moment.views[camera].seen.none()) continue;
    sum += moment.world_from_body.translation;
    count += 1.0;
  }
  return sum / std::max(count, 1.0);
}

void ColdStart::judge() {
  if (!bundle_.succeeded() || bundle_.medianSigmas() > options_.good_median) {
    // Somebody's names are wrong, or the pad was no pad; whose does not show.
    for (std::size_t c = 0; c < models_.size(); ++c) drop(c);
    maker_.forget();
    count_ = pad_count_ = 0;
    last_camera_ = -1;
    stage_ = world_is_given_ ? Stage::kWave : Stage::kStand;
    for (Still& still : still_) still.known = false;
    fresh_answer_ = true;
    return;
  }
  int good = 0;
  const double inflation = lastingInflation(
      std::span(moments_).subspan(static_cast<std::size_t>(pad_count_), static_cast<std::size_t>(count_ - pad_count_)),
      options_.lasting_sigma_px, options_.lasting_time_s);
  for (std::size_t c = 0; c < models_.size(); ++c) {
    const BundleCamera& camera = bundle_.cameras()[c];
    if (!camera.used) continue;
    if (camera.inliers < options_.good_inliers * camera.balls) {
      drop(c);
      continue;
    }
    if (camera.given) {
      ++good;
      continue;
    }
    CameraEstimate& estimate = answer_[c];
    estimate.camera_from_world = camera.camera_from_world;
    estimate.covariance = inflation * camera.covariance;
    const double uncertainty = uncertaintyAround(models_[c], estimate, whereSeen(c), kReachM);
    estimate.status =
        uncertainty < options_.good_uncertainty_m ? CameraStatus::kCalibrated : CameraStatus::kCalibrating;
    good += estimate.status == CameraStatus::kCalibrated;
  }
  if (good >= 2) stage_ = Stage::kSolved;
  fresh_answer_ = true;
}

}  // namespace helical
