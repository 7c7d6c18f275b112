#include "ui/scene_frame_builder.h"

#include <gtest/gtest.h>

namespace helical {
namespace {

constexpr TimeNs kTick = kNanosecondsPerSecond / 60;

RigConfig rigOfOneCamera() {
  RigConfig rig;
  CameraConfig camera;
  camera.name = "Camera 1";
  camera.model = CameraModel(640, 480, 567.6, 567.6, 319.5, 239.5);
  rig.cameras.push_back(camera);
  return rig;
}

/// A camera two metres above the helicopter, looking down.
EngineSnapshot snapshotFromAbove(const RigConfig& rig) {
  EngineSnapshot snapshot;
  snapshot.time = kTick;
  snapshot.camera_count = 1;
  snapshot.markers = rig.markers_in_body;
  snapshot.marker_count = rig.markers_in_body.count();
  snapshot.pose_known = true;
  CameraSnapshot& camera = snapshot.cameras[0];
  camera.estimate.status = CameraStatus::kCalibrated;
  camera.estimate.camera_from_world.rotation = Eigen::AngleAxisd(3.14159265358979, Eigen::Vector3d::UnitX());
  camera.estimate.camera_from_world.translation = Eigen::Vector3d(0.0, 0.0, 2.0);
  camera.track.exposure = snapshot.time;
  for (int i = 0; i < snapshot.marker_count; ++i) {
    MarkerTrack& marker = camera.track.markers[static_cast<std::size_t>(i)];
    marker.selected = true;
    marker.pixel = *rig.cameras[0].model.project(camera.estimate.camera_from_world *
                                                 rig.markers_in_body.inBody(markerId(i)));
  }
  return snapshot;
}

TEST(SceneFrameBuilder, SightRaysEndAtTheMarkersTheyShow) {
  const RigConfig rig = rigOfOneCamera();
  const EngineSnapshot snapshot = snapshotFromAbove(rig);
  SceneFrameBuilder builder(rig);
  builder.addTick(snapshot);
  const SceneFrame frame = builder.build(snapshot);
  ASSERT_EQ(frame.rays.size(), static_cast<std::size_t>(rig.markers_in_body.count()));
  for (int i = 0; i < rig.markers_in_body.count(); ++i) {
    const SceneRay& ray = frame.rays[static_cast<std::size_t>(i)];
    EXPECT_TRUE(ray.from.isApprox(Eigen::Vector3d(0.0, 0.0, 2.0), 1e-9));
    EXPECT_LT((ray.to - rig.markers_in_body.inBody(markerId(i))).norm(), 1e-6);
  }
}

TEST(SceneFrameBuilder, ALostHelicopterStaysAsAGhostWhereItWas) {
  const RigConfig rig = rigOfOneCamera();
  EngineSnapshot snapshot = snapshotFromAbove(rig);
  SceneFrameBuilder builder(rig);
  snapshot.pose_known = false;
  EXPECT_EQ(builder.build(snapshot).presence, Presence::kAbsent);
  snapshot.pose_known = true;
  snapshot.tracked.state.world_from_body.translation = {0.1, 0.2, 0.3};
  builder.addTick(snapshot);
  EXPECT_EQ(builder.build(snapshot).presence, Presence::kTracked);
  snapshot.pose_known = false;
  snapshot.tracked.state.world_from_body.translation.setZero();
  const SceneFrame lost = builder.build(snapshot);
  EXPECT_EQ(lost.presence, Presence::kLastKnown);
  EXPECT_TRUE(lost.world_from_body.translation.isApprox(Eigen::Vector3d(0.1, 0.2, 0.3)));
  EXPECT_TRUE(lost.rays.empty());
}

TEST(SceneFrameBuilder, ACameraWithoutAPoseIsNotDrawn) {
  const RigConfig rig = rigOfOneCamera();
  EngineSnapshot snapshot = snapshotFromAbove(rig);
  SceneFrameBuilder builder(rig);
  EXPECT_TRUE(builder.build(snapshot).cameras[0].known);
  EXPECT_TRUE(builder.build(snapshot).cameras[0].in_use);
  snapshot.cameras[0].hidden = true;
  EXPECT_FALSE(builder.build(snapshot).cameras[0].in_use);
  snapshot.cameras[0].estimate.status = CameraStatus::kUncalibrated;
  EXPECT_FALSE(builder.build(snapshot).cameras[0].known);
}

TEST(SceneFrameBuilder, ALearntPlaceIsShownWithItsSpreadItsTruthAndItsParticles) {
  const RigConfig rig = rigOfOneCamera();
  EngineSnapshot snapshot = snapshotFromAbove(rig);
  SceneFrameBuilder builder(rig);
  CameraSnapshot& camera = snapshot.cameras[0];
  camera.has_truth = true;
  EXPECT_FALSE(builder.build(snapshot).cameras[0].has_truth) << "its place was given: nothing to compare";
  camera.calibration_method = "particle-filter";
  EXPECT_TRUE(builder.build(snapshot).cameras[0].has_truth);
  EXPECT_FALSE(builder.build(snapshot).cameras[0].has_spread) << "a bare guess";
  camera.estimate.covariance.diagonal() << 1e-4, 1e-4, 1e-4, 4e-4, 1e-4, 9e-4;
  const SceneCameraPose pose = builder.build(snapshot).cameras[0];
  ASSERT_TRUE(pose.has_spread);
  EXPECT_NEAR(pose.spread_radii.maxCoeff(), 3 * 0.03, 1e-9);
  EXPECT_NEAR(pose.spread_radii.minCoeff(), 3 * 0.01, 1e-9);
  EXPECT_NEAR(pose.spread_angle, 3 * 0.01, 1e-9);
  EXPECT_NEAR((pose.spread_axes * Eigen::Vector3d::UnitZ()).cwiseAbs().z(), 1.0, 1e-9) << "largest along z";

  CalibrationView view;
  view.total = view.count = 2;
  view.particles[1] = {{1.0F, 2.0F, 3.0F}, 0.5F};
  builder.setCalibration(0, view);
  const SceneFrame frame = builder.build(snapshot);
  ASSERT_EQ(frame.particles.size(), 2U);
  EXPECT_TRUE(frame.particles[1].position.isApprox(Eigen::Vector3d(1.0, 2.0, 3.0)));
}

TEST(SceneFrameBuilder, TheFenceLightsUpNearIt) {
  const RigConfig rig = rigOfOneCamera();
  EngineSnapshot snapshot = snapshotFromAbove(rig);
  SceneFrameBuilder builder(rig);
  snapshot.tracked.state.world_from_body.translation = {0.1, 0.0, 0.5};
  EXPECT_EQ(builder.build(snapshot).fence_nearness, 0.0);
  snapshot.tracked.state.world_from_body.translation = {rig.safety.fence_radius, 0.0, 0.5};
  EXPECT_EQ(builder.build(snapshot).fence_nearness, 1.0);
  snapshot.tracked.state.world_from_body.translation = {0.0, 0.0, rig.safety.fence_height - 0.2};
  EXPECT_GT(builder.build(snapshot).fence_nearness, 0.3);
}

TEST(SceneFrameBuilder, RotorsTurnAgainstEachOtherAndStandWithoutDemand) {
  const RigConfig rig = rigOfOneCamera();
  EngineSnapshot snapshot = snapshotFromAbove(rig);
  SceneFrameBuilder builder(rig);
  builder.addTick(snapshot);
  EXPECT_EQ(builder.build(snapshot).upper_angle, 0.0);
  snapshot.sticks.upper_rotor = snapshot.sticks.lower_rotor = 0.5;
  snapshot.time += kTick;
  builder.addTick(snapshot);
  const SceneFrame frame = builder.build(snapshot);
  EXPECT_LT(frame.upper_angle * frame.lower_angle, 0.0);
}

TEST(SceneFrameBuilder, TheTrailForgets) {
  const RigConfig rig = rigOfOneCamera();
  EngineSnapshot snapshot = snapshotFromAbove(rig);
  SceneFrameBuilder builder(rig);
  std::size_t longest = 0;
  for (int i = 0; i < 60 * 60; ++i) {
    snapshot.time += kTick;
    builder.addTick(snapshot);
    longest = std::max(longest, builder.build(snapshot).trail.size());
  }
  EXPECT_GT(longest, 50U);
  EXPECT_LT(longest, 500U);
}

}  // namespace
}  // namespace helical
