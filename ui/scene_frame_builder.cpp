#include "ui/scene_frame_builder.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "engine/geometry/rotation.h"
#include "ui/coverage.h"
#include "ui/status_words.h"
#include "ui/theme.h"

namespace helical {
namespace {

constexpr TimeNs kTrailLength = 12 * kNanosecondsPerSecond;
constexpr TimeNs kTrailStep = 50 * kNanosecondsPerMillisecond;
constexpr std::array<double, 4> kCoverageHeights{0.01, 0.3, 0.6, 0.9};  // of the fence's
constexpr double kCoverageReach = 2.0;                                  // of the fence's radius
constexpr double kFenceSeen = 0.6;  // m from it the fence begins to light up
constexpr TimeNs kRayLife = 100 * kNanosecondsPerMillisecond;
/// True rotor speed would alias at the scene's frame rate; this one is seen to turn.
constexpr double kShownRotorSpeed = 30.0;  // rad/s at full demand

/// The ellipsoid of three standard deviations of a camera's place, and how far its axis may be off.
void addSpread(const CameraEstimate& estimate, SceneCameraPose& pose) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(estimate.covariance.bottomRightCorner<3, 3>());
  if (axes.eigenvalues().z() <= 0.0) return;
  Eigen::Matrix3d rotation = axes.eigenvectors();
  if (rotation.determinant() < 0.0) rotation.col(0) *= -1.0;
  pose.has_spread = true;
  pose.spread_axes = Eigen::Quaterniond(rotation);
  pose.spread_radii = 3.0 * axes.eigenvalues().cwiseMax(1e-8).cwiseSqrt();
  pose.spread_angle = 3.0 * std::sqrt(0.5 * estimate.covariance.topLeftCorner<2, 2>().trace());
}

SceneCameraPose cameraPose(const CameraSnapshot& camera) {
  SceneCameraPose pose;
  const CameraStatus status = camera.estimate.status;
  pose.known = status != CameraStatus::kUncalibrated;
  pose.in_use = status == CameraStatus::kCalibrated && !camera.hidden;
  pose.camera_from_world = camera.estimate.camera_from_world;
  if (camera.calibration_method == nullptr) return pose;
  pose.has_truth = camera.has_truth;
  pose.true_camera_from_world = camera.true_camera_from_world;
  addSpread(camera.estimate, pose);
  return pose;
}

/// Too little moved for the border of what it sees to look different.
bool near(const RigidTransform& a, const RigidTransform& b) {
  return a.rotation.angularDistance(b.rotation) < 0.01 &&
         (a.inverseTranslation() - b.inverseTranslation()).norm() < 0.02;
}

}  // namespace

SceneSetup sceneSetup(const RigConfig& rig) {
  SceneSetup setup;
  setup.markers = rig.markers_in_body;
  setup.helicopter = rig.helicopter;
  setup.fence_radius = rig.safety.fence_radius;
  setup.fence_height = rig.safety.fence_height;
  for (std::size_t i = 0; i < rig.cameras.size(); ++i)
    setup.cameras.push_back({QString::fromStdString(rig.cameras[i].name),
                             theme::on_dark::cameraColor(static_cast<int>(i)), rig.cameras[i].model});
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

void SceneFrameBuilder::setCalibration(int camera, const CalibrationView& view) {
  auto& particles = particles_[static_cast<std::size_t>(camera)];
  particles.clear();
  for (int i = 0; i < view.count; ++i) {
    const auto& particle = view.particles[static_cast<std::size_t>(i)];
    particles.push_back({camera, particle.centre_in_world.cast<double>(), particle.weight});
  }
}

void SceneFrameBuilder::setPlan(const FlightPlan& plan, bool draft) {
  plan_above_pad_.clear();
  for (const Waypoint& waypoint : plan.waypoints) plan_above_pad_.push_back(waypoint.position_above_pad);
  plan_is_draft_ = draft;
}

void SceneFrameBuilder::addToTrail(const EngineSnapshot& tick) {
  if (!trail_.empty() && tick.time < trail_.back().time) trail_.clear();  // a recording was wound back
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
  const CameraModel model =
      rig_.cameras[static_cast<std::size_t>(camera)].model.withFocalScale(seen.focal_scale);
  const RigidTransform world_from_camera = seen.estimate.camera_from_world.inverse();
  for (int i = 0; i < snapshot.marker_count; ++i) {
    const MarkerTrack& marker = seen.track.markers[static_cast<std::size_t>(i)];
    if (!marker.selected) continue;
    // The measured direction, as long as the marker is believed to be far.
    const Eigen::Vector3d direction =
        world_from_camera.rotation * model.bearing(marker.pixel).homogeneous().normalized();
    const Eigen::Vector3d ball = frame.world_from_body * snapshot.markers.inBody(markerId(i));
    const double length = (ball - world_from_camera.translation).norm();
    frame.rays.push_back(
        {camera, world_from_camera.translation, world_from_camera.translation + length * direction});
  }
}

void SceneFrameBuilder::updateCoverage(const SceneFrame& frame) {
  const bool same = std::equal(frame.cameras.begin(), frame.cameras.end(), covering_.begin(), covering_.end(),
                               [](const SceneCameraPose& now, const SceneCameraPose& then) {
                                 return now.in_use == then.in_use &&
                                        (!now.in_use || near(now.camera_from_world, then.camera_from_world));
                               });
  if (same) return;
  covering_ = frame.cameras;
  std::vector<CoveringCamera> cameras;
  for (std::size_t i = 0; i < covering_.size(); ++i)
    if (covering_[i].in_use) cameras.push_back({&rig_.cameras[i].model, covering_[i].camera_from_world});
  std::vector<double> heights;
  for (const double share : kCoverageHeights) heights.push_back(share * rig_.safety.fence_height);
  coverage_ = std::make_shared<const std::vector<Eigen::Vector3d>>(
      coverageContours(cameras, heights, kCoverageReach * rig_.safety.fence_radius));
}

double SceneFrameBuilder::fenceNearness(const SceneFrame& frame) const {
  if (frame.presence != Presence::kTracked) return 0.0;
  const Eigen::Vector3d& place = frame.world_from_body.translation;
  const double left = std::min(rig_.safety.fence_radius - place.head<2>().norm(),
                               rig_.safety.fence_height - (place.z() - frame.floor_height));
  return std::clamp(1.0 - left / kFenceSeen, 0.0, 1.0);
}

SceneFrame SceneFrameBuilder::build(const EngineSnapshot& snapshot) {
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
    frame.cameras.push_back(cameraPose(camera));
    addRays(snapshot, i, frame);
    const auto& particles = particles_[static_cast<std::size_t>(i)];
    frame.particles.insert(frame.particles.end(), particles.begin(), particles.end());
  }
  const Eigen::Vector3d stand(0.0, 0.0, snapshot.pad_height);
  for (const Eigen::Vector3d& waypoint : plan_above_pad_) frame.plan.push_back(stand + waypoint);
  frame.plan_is_draft = plan_is_draft_;
  frame.fence_nearness = fenceNearness(frame);
  if (coverage_shown_) {
    updateCoverage(frame);
    frame.coverage = coverage_;
  }
  return frame;
}

}  // namespace helical
