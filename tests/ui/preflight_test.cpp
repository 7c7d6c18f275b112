#include "ui/preflight.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace helical {
namespace {

RigConfig rigOfTwo() {
  RigConfig rig;
  for (const char* name : {"Camera 1", "Camera 2"}) {
    CameraConfig camera;
    camera.name = name;
    camera.model = CameraModel(640, 480, 500.0, 500.0, 319.5, 239.5);
    rig.cameras.push_back(camera);
  }
  return rig;
}

/// All well, standing on the pad.
EngineSnapshot readySnapshot() {
  EngineSnapshot now;
  now.time = 10 * kNanosecondsPerSecond;
  now.camera_count = 2;
  now.pose_known = true;
  now.tracked.pose_covariance = 1e-8 * Matrix6d::Identity();
  now.ticks_per_second = 60.0;
  now.server_p99 = kNanosecondsPerMillisecond;
  for (CameraSnapshot& camera : now.cameras) {
    camera.frames = 600;
    camera.frames_per_second = 60.0;
    camera.estimate.status = CameraStatus::kCalibrated;
    camera.track.exposure = now.time;
    camera.track.selected_count = 4;
  }
  return now;
}

Readiness of(const EngineSnapshot& now, const QString& name) {
  const auto items = preflightList(rigOfTwo(), now);
  const auto item =
      std::find_if(items.begin(), items.end(), [&](const PreflightItem& i) { return i.name == name; });
  if (item == items.end()) {
    ADD_FAILURE() << name.toStdString();
    return Readiness::kGood;
  }
  EXPECT_FALSE(item->detail.isEmpty());
  return item->readiness;
}

TEST(Preflight, EverythingIsListedAlsoWhatIsWell) {
  const auto items = preflightList(rigOfTwo(), readySnapshot());
  EXPECT_EQ(items.size(), 7U);
  EXPECT_EQ(worstOf(items), Readiness::kGood);
}

TEST(Preflight, WhatTheAutopilotWouldRefuseForIsBad) {
  EngineSnapshot now = readySnapshot();
  now.obstacle = "it does not stand on the pad";
  EXPECT_EQ(of(now, "Helicopter"), Readiness::kBad);
  const auto items = preflightList(rigOfTwo(), now);
  EXPECT_EQ(items.front().detail, "it does not stand on the pad");
}

TEST(Preflight, NoPoseAndNoCameraAreBad) {
  EngineSnapshot now = readySnapshot();
  now.pose_known = false;
  EXPECT_EQ(of(now, "Pose"), Readiness::kBad);
  for (CameraSnapshot& camera : now.cameras) camera.track.selected_count = 0;
  EXPECT_EQ(of(now, "Control set"), Readiness::kBad);
}

TEST(Preflight, OneCameraLeftIsACaution) {
  EngineSnapshot now = readySnapshot();
  now.cameras[1].track.selected_count = 0;
  EXPECT_EQ(of(now, "Control set"), Readiness::kCaution);
}

TEST(Preflight, ACameraSaysWhatIsTheMatterWithIt) {
  const auto changed = [](const auto& change) {
    EngineSnapshot now = readySnapshot();
    change(now.cameras[1]);
    return of(now, "Camera 2");
  };
  EXPECT_EQ(changed([](CameraSnapshot&) {}), Readiness::kGood);
  EXPECT_EQ(changed([](CameraSnapshot& c) { c.frames = 0; }), Readiness::kCaution);
  EXPECT_EQ(changed([](CameraSnapshot& c) { c.hidden = true; }), Readiness::kCaution);
  EXPECT_EQ(changed([](CameraSnapshot& c) { c.boards = 1; }), Readiness::kCaution);
  EXPECT_EQ(changed([](CameraSnapshot& c) { c.frames_per_second = 20.0; }), Readiness::kCaution);
  EXPECT_EQ(changed([](CameraSnapshot& c) { c.dropped = 60; }), Readiness::kCaution);
  EXPECT_EQ(changed([](CameraSnapshot& c) { c.estimate.status = CameraStatus::kRejected; }),
            Readiness::kCaution);
}

TEST(Preflight, ASlowFlightThreadIsACaution) {
  EngineSnapshot now = readySnapshot();
  now.server_p99 = 12 * kNanosecondsPerMillisecond;
  EXPECT_EQ(of(now, "Flight thread"), Readiness::kCaution);
}

TEST(Preflight, AfterTheCutNothingStarts) {
  EngineSnapshot now = readySnapshot();
  now.safety = SafetyState::kCut;
  EXPECT_EQ(of(now, "Safety"), Readiness::kBad);
  now.phase = FlightPhase::kOff;
  EXPECT_EQ(of(now, "Helicopter"), Readiness::kBad);
}

}  // namespace
}  // namespace helical
