#include "ui/scene_frame_builder.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/rotation.h"
#include "ui/status_words.h"
#include "ui/theme.h"

namespace helical {
namespace {

constexpr TimeNs kTrailLength = 12 * kNanosecondsPerSecond;
constexpr TimeNs kTrailStep = 50 * kNanosecondsPerMillisecond;
constexpr TimeNs kRayLife = 100 * kNanosecondsPerMillisecond;
/// True rotor speed would alias at the scene's frame rate; this one is seen to turn.
constexpr double kShownRotorSpeed = 30.0;  // rad/s at full demand

}  // namespace

SceneSetup sceneSetup(const RigConfig& rig) {
  SceneSetup setup;
  setup.markers = rig.markers_in_body;
  setup.helicopter = rig.helicopter;
  for (std::size_t i = 0; i < rig.cameras.size(); ++i)
    setup.cameras.push_back({QString::fromStdString(rig.cameras[i].name),
                             theme::cameraColor(static_cast<int>(i)), rig.cameras[i].model});
  return setup;
}

SceneFrameBuilder::SceneFrameBuilder(const RigConfig& rig) : rig_(rig) {}

void SceneFrameBuilder::addTick(const EngineSnapshot& tick) {
  turnRotors(tick);
  last_tick_ = tick.time;
  if (!tick.pose_known) return;
  ever_tracked_ = true;
  last_pose_ = tick.tracked.state.world_from_body;
  addToTrail(tick);
}

void SceneFrameBuilder::addToTrail(const EngineSnapshot& tick) {
  if (trail_.empty() || tick.time - trail_.back().time >= kTrailStep)
    trail_.push_back({tick.time, last_pose_.translation});
  while (tick.time - trail_.front().time > kTrailLength) trail_.pop_front();
}

void SceneFrameBuilder::turnRotors(const EngineSnapshot& tick) {
  const double elapsed = std::clamp(toSeconds(tick.time - last_tick_), 0.0, 0.2);
  upper_angle_ = wrapAngle(upper_angle_ - kShownRotorSpeed * tick.sticks.upper_rotor * elapsed);
  lower_angle_ = wrapAngle(lower_angle_ + kShownRotorSpeed * tick.sticks.lower_rotor * elapsed);
}

void SceneFrameBuilder::addRays(const EngineSnapshot& snapshot, int camera, SceneFrame& frame) const {
  const CameraSnapshot& seen = snapshot.cameras[static_cast<std::size_t>(camera)];
  if (!snapshot.pose_known || snapshot.time - seen.track.exposure > kRayLife) return;
  const CameraModel& model = rig_.cameras[static_cast<std::size_t>(camera)].model;
  const RigidTransform world_from_camera = seen.estimate.camera_from_world.inverse();
  for (int i = 0; i < snapshot.marker_count; ++i) {
    const MarkerTrack& marker = seen.track.markers[static_cast<std::size_t>(i)];
    if (!marker.selected) continue;
    // The measured direction, as long as the marker is believed to be far.
    const Eigen::Vector3d direction =
        world_from_camera.rotation * model.bearing(marker.pixel).homogeneous().normalized();
    const Eigen::Vector3d ball = frame.world_from_body * rig_.markers_in_body.inBody(markerId(i));
    const double length = (ball - world_from_camera.translation).norm();
    frame.rays.push_back(
        {camera, world_from_camera.translation, world_from_camera.translation + length * direction});
  }
}

SceneFrame SceneFrameBuilder::build(const EngineSnapshot& snapshot) const {
  SceneFrame frame;
  frame.presence = snapshot.pose_known ? Presence::kTracked
                   : ever_tracked_     ? Presence::kLastKnown
                                       : Presence::kAbsent;
  frame.world_from_body = snapshot.pose_known ? snapshot.tracked.state.world_from_body : last_pose_;
  frame.floor_height = snapshot.pad_height - rig_.helicopter.standing_height;
  frame.upper_angle = upper_angle_;
  frame.lower_angle = lower_angle_;
  frame.upper_demand = snapshot.sticks.upper_rotor;
  frame.lower_demand = snapshot.sticks.lower_rotor;
  frame.has_set_point = hasReference(snapshot);
  frame.set_point = snapshot.set_point.position_in_world;
  for (const TrailPoint& point : trail_) frame.trail.push_back(point.position);
  for (int i = 0; i < snapshot.camera_count; ++i) {
    const CameraSnapshot& camera = snapshot.cameras[static_cast<std::size_t>(i)];
    const CameraStatus status = camera.estimate.status;
    frame.cameras.push_back({status != CameraStatus::kUncalibrated,
                             status == CameraStatus::kCalibrated && !camera.hidden,
                             camera.estimate.camera_from_world});
    addRays(snapshot, i, frame);
  }
  return frame;
}

}  // namespace helical
