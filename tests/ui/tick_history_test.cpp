#include "ui/tick_history.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace helical {
namespace {

EngineSnapshot tickAt(double time_s) {
  EngineSnapshot tick;
  tick.time = fromSeconds(time_s);
  tick.marker_count = 4;
  return tick;
}

double value(const TickHistory& history, FlightColumn column) {
  return history.value(history.end() - 1, TickHistory::column(column));
}
double value(const TickHistory& history, int camera, CameraColumn column) {
  return history.value(history.end() - 1, history.column(camera, column));
}

TEST(TickHistory, WhatTheEngineDoesNotSayIsMissing) {
  TickHistory history(1);
  history.add(tickAt(1.0));
  for (const auto column : {FlightColumn::kX, FlightColumn::kYaw, FlightColumn::kReferenceX,
                            FlightColumn::kPositionError, FlightColumn::kPositionSigma})
    EXPECT_TRUE(std::isnan(value(history, column))) << static_cast<int>(column);
  for (const auto column : {CameraColumn::kPositionError, CameraColumn::kPositionSigma,
                            CameraColumn::kEffective, CameraColumn::kResidual})
    EXPECT_TRUE(std::isnan(value(history, 0, column))) << static_cast<int>(column);
  EXPECT_EQ(value(history, 0, CameraColumn::kSelected), 0.0);
}

TEST(TickHistory, YawGoesOnBeyondHalfATurn) {
  TickHistory history(0);
  EngineSnapshot tick = tickAt(0.0);
  tick.pose_known = true;
  for (int degrees = 0; degrees <= 350; degrees += 10) {
    tick.tracked.state.world_from_body.rotation =
        Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, Eigen::Vector3d::UnitZ());
    history.add(tick);
    EXPECT_NEAR(value(history, FlightColumn::kYaw), degrees, 1e-3);
  }
}

TEST(TickHistory, AnErrorIsThatOfTheCameraAgainstItsTruePlace) {
  TickHistory history(2);
  EngineSnapshot tick = tickAt(1.0);
  CameraSnapshot& camera = tick.cameras[1];
  camera.calibration_method = "particle-filter";
  camera.has_truth = true;
  camera.estimate.camera_from_world.translation = {-0.3, 0.0, 0.4};
  camera.estimate.covariance.diagonal() << 1e-4, 1e-4, 2e-4, 1e-6, 1e-6, 2e-6;
  history.add(tick);
  EXPECT_NEAR(value(history, 1, CameraColumn::kPositionError), 0.5, 1e-6);
  EXPECT_NEAR(value(history, 1, CameraColumn::kOrientationError), 0.0, 1e-6);
  EXPECT_NEAR(value(history, 1, CameraColumn::kPositionSigma), 2e-3, 1e-6);
  EXPECT_NEAR(value(history, 1, CameraColumn::kOrientationSigma), 0.02 * 180.0 / std::numbers::pi, 1e-4);
  EXPECT_TRUE(std::isnan(value(history, 0, CameraColumn::kPositionError))) << "its place was given";
}

TEST(TickHistory, OnlyFreshFramesCount) {
  TickHistory history(1);
  EngineSnapshot tick = tickAt(10.0);
  CameraTrack& track = tick.cameras[0].track;
  track.exposure = tick.time;
  track.selected_count = 2;
  track.residual_px = 0.5;
  track.markers[0].selected = track.markers[3].selected = true;
  history.add(tick);
  EXPECT_EQ(value(history, 0, CameraColumn::kSelected), 9.0);
  EXPECT_EQ(value(history, 0, CameraColumn::kResidual), 0.5);
  tick.time = fromSeconds(11.0);
  history.add(tick);
  EXPECT_EQ(value(history, 0, CameraColumn::kSelected), 0.0);
}

TEST(TickHistory, RowsAreFoundByTimeAlsoAfterTheOldestAreForgotten) {
  TickHistory history(0);
  const int count = static_cast<int>(TickHistory::kCapacity) + 500;
  for (int i = 0; i < count; ++i) history.add(tickAt(0.01 * i));
  EXPECT_EQ(history.first(), 500);
  EXPECT_EQ(history.end(), count);
  EXPECT_EQ(history.rowAt(0.0), 500);
  EXPECT_EQ(history.rowAt(100.0), 10'000);
  EXPECT_EQ(history.rowAt(100.005), 10'001);
  EXPECT_EQ(history.rowAt(1e9), count);
  EXPECT_NEAR(history.time(10'000), 100.0, 1e-9);
}

}  // namespace
}  // namespace helical
