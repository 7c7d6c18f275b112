#include "engine/pipeline/cable_watch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/geometry/rotation.h"

namespace helical {
namespace {

constexpr int kOddFrames = 4;  // in a row, before a camera counts as one that disagrees
constexpr int kTriesForAChange = 3;
constexpr int kTriesToComeBack = 10;
constexpr int kEager = 180;  // frames, each with a try; then every sixth has one
constexpr int kSeldom = 6;
constexpr int kFewestWitnesses = 2;    // cameras that show what the pose says
constexpr int kFewestBalls = 3;        // that a camera must show to say anything
constexpr int kAgreeing = 2;           // balls in place; a camera with fewer disagrees
constexpr double kNearPx = 4.0;        // a ball is where a pose says
constexpr double kWellPx = 1.5;        // of a fit: frames are up to a frame apart
constexpr double kClearlyWorse = 2.0;  // times another misfit
constexpr double kNone = std::numeric_limits<double>::infinity();
constexpr TimeNs kNow = 50 * kNanosecondsPerMillisecond;
constexpr double kAstrayM = 0.7;
constexpr double kYawSigma = 0.5;  // rad: of a layout that looks the same from other sides, the nearest
constexpr double kForeseen = 0.3;  // s, over which the tracker's prediction says where to search

/// Near where the tracker believes it to be, turned any way: what it saw last may have been a camera that
/// shows what another one should.
PosePrior priorFor(TimeNs now, const Tracker& tracker, bool airborne, double standing_height) {
  PosePrior prior;
  prior.world_from_body.translation.z() = standing_height;
  if (!tracker.acquired()) return prior;
  const double gap = std::max(0.0, toSeconds(now - tracker.lastUpdate()));
  const TimeNs foreseen = tracker.lastUpdate() + fromSeconds(std::min(gap, kForeseen));
  prior.world_from_body = tracker.predict(foreseen, airborne).state.world_from_body;
  prior.position_radius += kAstrayM + 1.5 * gap;
  prior.yaw_range = kPi;
  prior.yaw_sigma = kYawSigma;
  prior.tilt_limit = 0.8;
  return prior;
}

}  // namespace

CableWatch::CableWatch(const MarkerLayout& markers, std::vector<CameraModel> cameras, double standing_height)
    : markers_(markers),
      cameras_(std::move(cameras)),
      standing_height_(standing_height),
      acquisition_(markers, cameras_) {
  for (int i = 0; i < kMaxCameras; ++i) camera_of_[static_cast<std::size_t>(i)] = cameraId(i);
}

void CableWatch::correct(const MarkerLayout& markers, std::span<const CameraModel> cameras) {
  markers_ = markers;
  std::copy(cameras.begin(), cameras.end(), cameras_.begin());
  acquisition_.correct(markers, cameras);
}

bool CableWatch::isOdd(std::size_t camera, TimeNs now) const {
  return odd_frames_[camera] >= kOddFrames && now - newest_[camera].exposure < kNow;
}

bool CableWatch::isPair(std::size_t a, std::size_t b, const Moment& moment) const {
  const auto shows = [&](std::size_t camera) {
    return moment.places[camera] != nullptr && newest_[camera].count >= kFewestBalls &&
           moment.now - newest_[camera].exposure < kNow;
  };
  return a < b && shows(a) && shows(b) && (isOdd(a, moment.now) || isOdd(b, moment.now));
}

void CableWatch::nextPair(const Moment& moment) {
  const std::size_t count = cameras_.size();
  for (std::size_t step = 0; step < count * count; ++step) {
    b_ = (b_ + 1) % count;
    if (b_ == 0) a_ = (a_ + 1) % count;
    if (isPair(a_, b_, moment)) return;
  }
}

bool CableWatch::showsBallsOf(const RigidTransform& world_from_body, std::size_t camera,
                              const CameraEstimate& place, const Observation& shown) const {
  int near = 0;
  for (const Eigen::Vector3d& marker : markers_.all()) {
    const auto pixel = cameras_[camera].project(place.camera_from_world * (world_from_body * marker));
    if (!pixel) continue;
    const auto end = shown.centroids.begin() + shown.count;
    near += std::any_of(shown.centroids.begin(), end,
                        [&](const Centroid& c) { return (c.pixel - *pixel).norm() < kNearPx; });
  }
  return near >= kFewestBalls;
}

double CableWatch::misfit(std::size_t a, std::size_t b, bool changed, const Moment& moment) {
  std::array<CameraEstimate, kMaxCameras> estimates;
  std::array<bool, kMaxCameras> asked{};
  std::array<std::size_t, kMaxCameras> shown_by{};
  const std::size_t count = cameras_.size();
  for (std::size_t i = 0; i < count; ++i) {
    shown_by[i] = !changed ? i : i == a ? b : i == b ? a : i;
    asked[i] = moment.places[i] != nullptr && (i == a || i == b || moment.usable[i]) &&
               moment.now - newest_[shown_by[i]].exposure < kNow;
    if (!asked[i]) continue;
    estimates[i] = *moment.places[i];
    Observation shown = newest_[shown_by[i]];
    shown.camera = cameraId(static_cast<int>(i));
    acquisition_.add(shown);
  }
  const auto fit =
      acquisition_.attempt(moment.now, {estimates.data(), count}, {asked.data(), count},
                           priorFor(moment.now, moment.tracker, moment.airborne, standing_height_));
  if (!fit) return kNone;
  int witnesses = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const bool shows = asked[i] && showsBallsOf(fit->world_from_body, i, estimates[i], newest_[shown_by[i]]);
    if (!shows && (i == a || i == b)) return kNone;
    witnesses += shows;
  }
  return witnesses >= kFewestWitnesses ? fit->rms_px : kNone;
}

void CableWatch::noteWhetherOdd(const Observation& observation, const Moment& moment) {
  const std::size_t index = indexOf(observation.camera);
  newest_[index] = observation;
  const bool odd = moment.places[index] != nullptr &&
                   std::min(observation.count, markers_.count()) >= kFewestBalls &&
                   moment.tracker.track(observation.camera).agreeing_count < kAgreeing;
  odd_frames_[index] = odd ? std::min(odd_frames_[index] + 1, kOddFrames) : 0;
  if (odd) return;
  tries_[index] = good_tries_[index] = 0;
}

void CableWatch::forgetPairs() {
  for (auto& pairs : pairs_) pairs.fill({});
}

CableWatch::Verdict CableWatch::askAlone(std::size_t camera, const Moment& moment) {
  good_tries_[camera] = misfit(camera, camera, false, moment) < kWellPx ? good_tries_[camera] + 1 : 0;
  if (good_tries_[camera] < kTriesToComeBack) return {};
  odd_frames_[camera] = tries_[camera] = good_tries_[camera] = 0;
  const CameraId id = cameraId(static_cast<int>(camera));
  return {Finding::kAgreesAgain, id, id};
}

bool CableWatch::othersAreWorse(std::size_t a, std::size_t b, const Moment& moment) const {
  for (std::size_t c = 0; c < cameras_.size(); ++c)
    for (std::size_t d = c + 1; d < cameras_.size(); ++d) {
      const bool other = isPair(c, d, moment) && (c != a || d != b);
      if (other && pairs_[c][d].misfit < kClearlyWorse * pairs_[a][b].misfit) return false;
    }
  return true;
}

CableWatch::Verdict CableWatch::askPair(const Moment& moment) {
  nextPair(moment);
  Pair& pair = pairs_[a_][b_];
  pair.misfit = misfit(a_, b_, true, moment);
  pair.good = pair.misfit < kWellPx ? pair.good + 1 : 0;
  if (pair.good < kTriesForAChange || !othersAreWorse(a_, b_, moment)) return {};
  if (misfit(a_, b_, false, moment) < kClearlyWorse * pair.misfit) return {};
  const CameraId first = cameraId(static_cast<int>(a_)), second = cameraId(static_cast<int>(b_));
  for (CameraId& camera : camera_of_)
    if (camera == first || camera == second) camera = camera == first ? second : first;
  odd_frames_.fill(0);
  tries_.fill(0);
  good_tries_.fill(0);
  forgetPairs();
  ++changes_;
  return {Finding::kChanged, first, second};
}

CableWatch::Verdict CableWatch::add(const Observation& observation, const Places& places,
                                    std::span<const bool> usable, const Tracker& tracker, bool airborne) {
  const std::size_t index = indexOf(observation.camera);
  const Moment moment{observation.exposure, places, usable, tracker, airborne};
  noteWhetherOdd(observation, moment);
  if (!isOdd(index, moment.now)) return {};
  const int tries = ++tries_[index];
  if (tries > kEager && tries % kSeldom != 0) return {};
  const int turn = tries > kEager ? tries / kSeldom : tries;
  const bool set_aside = !usable[index];
  if (set_aside && turn % 2 == 0) return askAlone(index, moment);
  // One that disagrees alone was not exchanged.
  int disagree = 0;
  for (std::size_t i = 0; i < cameras_.size(); ++i) disagree += isOdd(i, moment.now);
  if (disagree >= 2) return askPair(moment);
  forgetPairs();
  return {};
}

}  // namespace helical
