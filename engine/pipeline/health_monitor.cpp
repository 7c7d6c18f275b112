#include "engine/pipeline/health_monitor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/geometry/rotation.h"

namespace helical {
namespace {

constexpr double kFade = 0.98;             // of a frame's or tick's weight with each one that follows
constexpr double kSmoothing = 0.1;         // share of the newest value
constexpr double kUsualSmoothing = 0.005;  // likewise, of a baseline
constexpr double kSilentIntervals = 3.0;   // a slow camera is not silent between its frames
constexpr TimeNs kFreshTrack = 100 * kNanosecondsPerMillisecond;
constexpr double kSmallResidual = 0.5;  // px: less is never a doubt
constexpr double kSamePlace = 0.01;     // m between markers that look the same
constexpr double kYawMargin = 0.1;      // rad
constexpr int kHighestSymmetry = 6;     // a layout turned by a whole turn over this, or less often

bool looksTheSame(const MarkerLayout& layout, double turn) {
  const Eigen::AngleAxisd rotation(turn, Eigen::Vector3d::UnitZ());
  const auto& all = layout.all();
  return std::all_of(all.begin(), all.end(), [&](const Eigen::Vector3d& marker) {
    const Eigen::Vector3d turned = rotation * marker;
    return std::any_of(all.begin(), all.end(),
                       [&](const Eigen::Vector3d& other) { return (other - turned).norm() < kSamePlace; });
  });
}

double unambiguousYaw(const MarkerLayout& layout) {
  for (int parts = kHighestSymmetry; parts > 1; --parts) {
    const double turn = 2.0 * std::numbers::pi / parts;
    if (looksTheSame(layout, turn)) return 0.5 * turn - kYawMargin;
  }
  return std::numbers::pi;
}

void smooth(double& value, double newest, double share) {
  value += share * (newest - value);
}

}  // namespace

HealthMonitor::HealthMonitor(const RigConfig& rig)
    : options_(rig.safety),
      period_s_(1.0 / rig.control.rate_hz),
      unambiguous_yaw_(unambiguousYaw(rig.markers_in_body)) {}

void HealthMonitor::onObservation(const Observation& observation, TimeNs now) {
  Camera& camera = cameras_[static_cast<std::size_t>(observation.camera.index())];
  camera.clock.add(observation);
  if (camera.seen) {
    const std::uint64_t step =
        observation.sequence > camera.last_sequence ? observation.sequence - camera.last_sequence : 1;
    camera.came = kFade * camera.came + 1.0;
    camera.missing = kFade * camera.missing + static_cast<double>(step - 1);
    smooth(camera.interval, toSeconds(now - camera.last_seen), kSmoothing);
  }
  camera.seen = true;
  camera.last_sequence = observation.sequence;
  camera.last_seen = now;
}

bool HealthMonitor::isSilent(const Camera& camera, TimeNs now) const {
  // The next tick would be too late to say so.
  return toSeconds(now - camera.last_seen) + period_s_ >
         std::max(options_.camera_silent_s, kSilentIntervals * camera.interval);
}

void HealthMonitor::watchCameras(TimeNs now, std::span<const bool> usable, SystemHealth& health) const {
  health.live_cameras = 0;
  for (std::size_t i = 0; i < usable.size(); ++i) {
    const Camera& camera = cameras_[i];
    if (!camera.seen) continue;
    const bool silent = isSilent(camera, now);
    health.camera_silent = health.camera_silent || silent;
    health.camera_clock_off = health.camera_clock_off || camera.clock.isOff();
    if (!usable[i] || silent || camera.clock.hasJumped()) continue;
    ++health.live_cameras;
    if (camera.came > 0.0)
      health.frame_share = std::min(health.frame_share, camera.came / (camera.came + camera.missing));
  }
}

void HealthMonitor::watchTicks(TimeNs now, SystemHealth& health) {
  if (last_tick_ >= 0) {
    const double passed = toSeconds(now - last_tick_);
    ticks_came_ = kFade * ticks_came_ + 1.0;
    ticks_due_ = kFade * ticks_due_ + passed / period_s_;
    health.overrun_s = std::max(0.0, passed - period_s_);
    health.tick_share = std::min(1.0, ticks_came_ / ticks_due_);
  }
  last_tick_ = now;
}

void HealthMonitor::watchPose(TimeNs now, std::span<const bool> usable, const EngineSnapshot& last,
                              SystemHealth& health) {
  const Matrix6d& covariance = last.tracked.pose_covariance;
  health.position_sigma = std::sqrt(covariance.diagonal().head<3>().sum());
  health.rotation_sigma = std::sqrt(covariance.diagonal().tail<3>().sum());
  health.cameras_disagree = last.cameras_disagree;
  health.yaw_ambiguous = std::abs(yawOf(last.tracked.state.world_from_body.rotation)) > unambiguous_yaw_;
  double squares = 0.0;
  int cameras = 0;
  for (std::size_t i = 0; i < usable.size(); ++i) {
    const CameraTrack& track = last.cameras[i].track;
    if (!usable[i] || track.selected_count == 0 || now - track.exposure > kFreshTrack) continue;
    squares += track.residual_px * track.residual_px;
    ++cameras;
  }
  if (cameras == 0) return;
  smooth(residual_, std::sqrt(squares / cameras), kSmoothing);
  if (usual_residual_ <= 0.0) usual_residual_ = residual_;
  health.residual_ratio = residual_ / std::max(usual_residual_, kSmallResidual);
  if (health.residual_ratio < options_.residual_limit) smooth(usual_residual_, residual_, kUsualSmoothing);
}

SystemHealth HealthMonitor::onTick(TimeNs now, std::span<const bool> usable, const EngineSnapshot& last,
                                   const DeviceStatus& devices) {
  SystemHealth health;
  watchCameras(now, usable, health);
  watchTicks(now, health);
  watchPose(now, usable, last, health);
  health.transmitter_ready = devices.transmitter.present && devices.transmitter.self_test_passed;
  health.transmitter_fault = devices.transmitter.fault || !devices.transmitter.present;
  health.channels_calibrated = devices.transmitter.channels_calibrated;
  health.pilot_flies = devices.transmitter.pilot_flies;
  health.record_failed = devices.record.cut_off;
  health.record_stalled = devices.record.stalled;
  health.disk_free_gb = devices.record.disk_free_gb;
  return health;
}

}  // namespace helical
