#include "engine/tracking/latest_images_tracker.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "engine/base/check.h"
#include "engine/geometry/rotation.h"

namespace helical {
namespace {

constexpr TimeNs kBetweenPoses = 12 * kNanosecondsPerMillisecond;  // one a round of 60 Hz images
constexpr TimeNs kLatestImage = 60 * kNanosecondsPerMillisecond;   // older ones count no more
constexpr TimeNs kLongestPrediction = 80 * kNanosecondsPerMillisecond;
constexpr TimeNs kLost = 300 * kNanosecondsPerMillisecond;  // then the pose is sought anew
constexpr double kVelocityS = 0.010;                        // time constant of the low-pass
constexpr int kIterations = 8;
constexpr double kLongestJump = 5.0;  // m: no pose of this field
constexpr double kEveryPixel = 1e9;   // px: each feature counts as it is
constexpr double kNamingGatePx = 12.0;
// How much the velocities may be off [m/s, rad/s], for the covariance of a prediction.
constexpr double kSpeedSigma = 0.1, kSpinSigma = 0.5;

}  // namespace

LatestImagesTracker::LatestImagesTracker(const MarkerLayout& markers, std::vector<CameraModel> cameras,
                                         double standing_height)
    : markers_(markers),
      cameras_(std::move(cameras)),
      standing_height_(standing_height),
      acquisition_(markers, cameras_) {
  for (std::size_t c = 0; c < cameras_.size(); ++c)
    views_.push_back({LabelKeeper({}, markers_.count()), {}, {}, false, {}});
}

void LatestImagesTracker::correct(const MarkerLayout& markers, std::span<const CameraModel> cameras) {
  markers_ = markers;
  std::copy(cameras.begin(), cameras.end(), cameras_.begin());
  acquisition_.correct(markers, cameras);
  corrected_ = true;
}

void LatestImagesTracker::adopt(const Tracker& other) {
  const auto* const same = dynamic_cast<const LatestImagesTracker*>(&other);
  HELICAL_CHECK(same != nullptr && same->cameras_.size() == cameras_.size());
  *this = *same;
}

TrackedState LatestImagesTracker::predict(TimeNs time, bool) const {
  TrackedState result{time, state_, Matrix6d::Identity()};
  if (!acquired_) return result;
  const double ahead = toSeconds(std::min(time - pose_time_, kLongestPrediction));
  RigidTransform& pose = result.state.world_from_body;
  pose.translation += ahead * state_.velocity_in_world;
  pose.rotation = (pose.rotation * expSO3(ahead * state_.angular_velocity_in_body)).normalized();
  const double unseen = toSeconds(time - pose_time_);
  result.pose_covariance = covariance_;
  result.pose_covariance.diagonal().head<3>().array() += kSpeedSigma * kSpeedSigma * unseen * unseen;
  result.pose_covariance.diagonal().tail<3>().array() += kSpinSigma * kSpinSigma * unseen * unseen;
  return result;
}

void LatestImagesTracker::update(const Observation& observation, std::span<const CameraEstimate> cameras,
                                 std::span<const bool> usable, bool) {
  const auto index = static_cast<std::size_t>(observation.camera.index());
  View& view = views_[index];
  view.track = CameraTrack{};
  view.track.exposure = observation.exposure;
  if (!usable[index] || (view.seen && observation.exposure < view.newest.exposure)) return;
  view.newest = observation;
  view.seen = true;
  view.names.fill(-1);
  acquisition_.add(observation);
  const bool gap = observation.exposure - pose_time_ > kLost;
  if ((!acquired_ || gap) && !acquire(observation, cameras, usable)) return;
  select(index, cameras[index]);
  if (observation.exposure - pose_time_ >= kBetweenPoses) solve(observation.exposure, cameras, usable);
  report(index, cameras[index]);
}

bool LatestImagesTracker::acquire(const Observation& observation, std::span<const CameraEstimate> cameras,
                                  std::span<const bool> usable) {
  PosePrior prior;
  prior.world_from_body.translation.z() = standing_height_;
  if (acquired_) {
    const double gap = toSeconds(observation.exposure - pose_time_);
    prior.world_from_body = state_.world_from_body;
    prior.position_radius += 1.5 * gap;
    prior.yaw_range = kPi;
    prior.yaw_sigma = 0.15 + gap;
    prior.tilt_limit = 0.8;
  }
  const auto fit = acquisition_.attempt(observation.exposure, cameras, usable, prior);
  if (!fit) return false;
  acquired_ = true;
  state_ = {};
  state_.world_from_body = fit->world_from_body;
  pose_time_ = observation.exposure - kBetweenPoses;
  for (View& view : views_) view.keeper.forget();
  return true;
}

Names LatestImagesTracker::namesFromPose(std::size_t camera, const CameraEstimate& estimate) const {
  std::array<MarkerPrediction, kMaxMarkers> predictions;
  const RigidTransform pose = predict(views_[camera].newest.exposure, true).state.world_from_body;
  for (int m = 0; m < markers_.count(); ++m) {
    const Eigen::Vector3d marker = estimate.camera_from_world * (pose * markers_.inBody(markerId(m)));
    const auto pixel = cameras_[camera].project(marker);
    if (!pixel || !cameras_[camera].contains(*pixel)) continue;
    predictions[static_cast<std::size_t>(m)] = {true, *pixel,
                                                kNamingGatePx * kNamingGatePx * Eigen::Matrix2d::Identity(),
                                                cameras_[camera].fx() * markers_.radius() / marker.z()};
  }
  return nameByPrediction({predictions.data(), static_cast<std::size_t>(markers_.count())},
                          views_[camera].newest, 1.0);
}

void LatestImagesTracker::select(std::size_t camera, const CameraEstimate& estimate) {
  View& view = views_[camera];
  if (!view.keeper.lost()) view.names = view.keeper.follow(view.newest);
  if (!view.keeper.lost()) return;
  view.names = namesFromPose(camera, estimate);
  view.keeper.restart(view.newest, view.names);
  if (view.keeper.lost()) view.names.fill(-1);
}

void LatestImagesTracker::solve(TimeNs time, std::span<const CameraEstimate> cameras,
                                std::span<const bool> usable) {
  std::size_t count = 0;
  double variance = 0.0;
  int named = 0;
  for (std::size_t c = 0; c < cameras_.size(); ++c) {
    const View& view = views_[c];
    if (!usable[c] || !view.seen || time - view.newest.exposure > kLatestImage) continue;
    synchronise(c, cameras[c], time, moved_[c]);
    solved_views_[count++] = {&cameras_[c], cameras[c].camera_from_world, &moved_[c], view.names};
    for (const int name : view.names) {
      if (name < 0) continue;
      variance += view.newest.centroids[static_cast<std::size_t>(name)].covariance.trace() / 2.0;
      ++named;
    }
  }
  PoseFit fit = fitPose({solved_views_.data(), count}, markers_, predict(time, true).state.world_from_body,
                        0.0, kIterations, kEveryPixel);
  // A marker behind a camera is a camera in the wrong place, not one to be left out.
  if (!fit.ok || fit.inliers < fit.named) return;
  if ((fit.world_from_body.translation - state_.world_from_body.translation).norm() > kLongestJump) return;
  fit.information /= variance / named + fit.rms_px * fit.rms_px;
  moveTo(fit, time);
}

void LatestImagesTracker::synchronise(std::size_t camera, const CameraEstimate& estimate, TimeNs time,
                                      Observation& moved) const {
  const View& view = views_[camera];
  moved = view.newest;
  const RigidTransform then = predict(view.newest.exposure, true).state.world_from_body;
  const RigidTransform now = predict(time, true).state.world_from_body;
  for (int m = 0; m < markers_.count(); ++m) {
    const int name = view.names[static_cast<std::size_t>(m)];
    if (name < 0) continue;
    const Eigen::Vector3d& marker = markers_.inBody(markerId(m));
    const auto from = cameras_[camera].project(estimate.camera_from_world * (then * marker));
    const auto to = cameras_[camera].project(estimate.camera_from_world * (now * marker));
    if (from && to) moved.centroids[static_cast<std::size_t>(name)].pixel += *to - *from;
  }
}

void LatestImagesTracker::moveTo(const PoseFit& fit, TimeNs time) {
  const double elapsed = toSeconds(time - pose_time_);
  const RigidTransform& last = state_.world_from_body;
  const double gain = corrected_ ? 0.0 : 1.0 - std::exp(-elapsed / kVelocityS);
  corrected_ = false;
  const Eigen::Vector3d velocity = (fit.world_from_body.translation - last.translation) / elapsed;
  const Eigen::Vector3d spin = logSO3(last.rotation.conjugate() * fit.world_from_body.rotation) / elapsed;
  state_.velocity_in_world += gain * (velocity - state_.velocity_in_world);
  state_.angular_velocity_in_body += gain * (spin - state_.angular_velocity_in_body);
  state_.world_from_body = fit.world_from_body;
  Matrix6d information = fit.information;
  information.diagonal().array() += 1.0;
  covariance_ = information.ldlt().solve(Matrix6d::Identity());
  pose_time_ = time;
}

void LatestImagesTracker::report(std::size_t camera, const CameraEstimate& estimate) {
  View& view = views_[camera];
  const RigidTransform pose = predict(view.newest.exposure, true).state.world_from_body;
  double squares = 0.0;
  for (int m = 0; m < markers_.count(); ++m) {
    const auto index = static_cast<std::size_t>(m);
    MarkerTrack& marker = view.track.markers[index];
    const auto pixel =
        cameras_[camera].project(estimate.camera_from_world * (pose * markers_.inBody(markerId(m))));
    if (pixel) {
      marker.predicted = true;
      view.track.predicted_count += cameras_[camera].contains(*pixel);
      marker.reprojected = *pixel;
    }
    if (view.names[index] < 0) continue;
    marker.observed = marker.agrees = marker.selected = true;  // it has no gates in 3D
    ++view.track.agreeing_count;
    marker.pixel = view.newest.centroids[static_cast<std::size_t>(view.names[index])].pixel;
    ++view.track.selected_count;
    if (pixel) squares += (marker.pixel - *pixel).squaredNorm();
  }
  if (view.track.selected_count > 0)
    view.track.residual_px = std::sqrt(squares / (2.0 * view.track.selected_count));
}

}  // namespace helical
