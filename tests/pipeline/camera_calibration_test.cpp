#include "engine/pipeline/camera_calibration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "engine/base/error.h"
#include "engine/config/plan_file.h"
#include "engine/config/resource_files.h"
#include "engine/geometry/rotation.h"
#include "engine/pipeline/rig_hardware.h"
#include "engine/simulator/disturbances.h"
#include "tests/pipeline/flight_fixture.h"

namespace helical {
namespace {

/// The paper's rig with camera 3 guessed 15 degrees and 0.4 m off.
RigConfig guessedRig(std::uint64_t seed, const std::string& method) {
  RigConfig rig = test::shippedRig("paper", seed);
  rig.cameras[2].camera_from_world =
      displaced(trueCameraFromWorld(rig, cameraId(2)), toRadians(15.0), 0.4, Random(seed));
  rig.cameras[2].pose_is_guess = true;
  rig.calibrator = method;
  return rig;
}

CameraError errorOf(const test::Flown& flown, const RigConfig& rig) {
  return cameraError(flown.last.cameras[2].estimate.camera_from_world, trueCameraFromWorld(rig, cameraId(2)));
}

TEST(CameraCalibration, GoodMethodsFindTheCameraAndItIsAdmitted) {
  for (const char* method : {"joint", "particle-filter", "growing-gauss-newton"}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const RigConfig rig = guessedRig(seed, method);
      const test::Flown flown = test::flyHover(rig);
      EXPECT_EQ(flown.outcome, "landed") << method << ", seed " << seed;
      EXPECT_EQ(flown.last.cameras[2].estimate.status, CameraStatus::kCalibrated)
          << method << ", seed " << seed;
      EXPECT_STREQ(flown.last.cameras[2].calibration_method, method);
      EXPECT_LT(errorOf(flown, rig).position, 0.01) << method << ", seed " << seed;
      EXPECT_LT(errorOf(flown, rig).orientation, toRadians(0.5)) << method << ", seed " << seed;
    }
  }
}

TEST(CameraCalibration, TheNewCameraFliesWhenTheSecondIsCovered) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    RigConfig rig = guessedRig(seed, "particle-filter");
    test::cover(rig, {1}, 13.0, 60.0);
    const test::Flown flown = test::flyHover(rig);
    EXPECT_EQ(flown.outcome, "landed") << "seed " << seed;
    EXPECT_GT(flown.score.selectedShare(cameraId(2)), 0.5) << "seed " << seed;
  }
}

TEST(CameraCalibration, ACameraThatWasCoveredKnowsItsPlaceStill) {
  for (const char* method : {"joint", "particle-filter", "growing-gauss-newton", "ekf"}) {
    RigConfig rig = guessedRig(2, method);
    test::cover(rig, {2}, 10.0, 12.0);
    LockStep flight(rig, loadPlan(planPath("hover")));
    OperatorCommands commands;
    for (double time = 0.0; time < 14.0;) {
      const EngineSnapshot& now = flight.tick(commands);
      commands.arm = commands.take_off = now.phase == FlightPhase::kIdle && now.failing_checks == 0;
      time = toSeconds(now.time);
      if (time > 9.0) {
        ASSERT_EQ(now.cameras[2].estimate.status, CameraStatus::kCalibrated) << method << " at " << time;
        ASSERT_LT(
            cameraError(now.cameras[2].estimate.camera_from_world, now.cameras[2].true_camera_from_world)
                .position,
            0.01)
            << method << " at " << time;
      }
      if (time > 13.0) {
        EXPECT_GT(now.cameras[2].track.selected_count, 0) << method;
      }
    }
  }
}

TEST(CameraCalibration, WhatDoesNotConvergeIsNotFlownOn) {
  const test::Flown flown = test::flyHover(guessedRig(1, "particle-filter-literal"));
  EXPECT_EQ(flown.outcome, "landed");
  EXPECT_NE(flown.last.cameras[2].estimate.status, CameraStatus::kCalibrated);
  EXPECT_EQ(flown.score.selectedShare(cameraId(2)), 0.0);
}

/// Four cameras over the corners of the field, of which the second and third are guessed 15 degrees and 0.4 m
/// off.
RigConfig twoGuessed(std::uint64_t seed, const std::string& method) {
  RigConfig rig = test::shippedRig("four-cameras", seed);
  rig.simulation.true_camera_from_world.resize(rig.cameras.size());
  for (const std::size_t i : {1U, 2U}) {
    const RigidTransform truth = *rig.cameras[i].camera_from_world;
    rig.simulation.true_camera_from_world[i] = truth;
    rig.cameras[i].camera_from_world = displaced(truth, toRadians(15.0), 0.4, Random(100 * seed + i));
    rig.cameras[i].pose_is_guess = true;
  }
  rig.calibrator = method;
  return rig;
}

class TwoCamerasAtOnce : public testing::TestWithParam<std::string_view> {};

TEST_P(TwoCamerasAtOnce, AreCalibratedOrStayOutAndTheFlightGoesOn) {
  const bool should_converge =
      GetParam() != "gauss-newton" && GetParam() != "particle-filter-literal";  // one frame; no process noise
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    RigConfig rig = twoGuessed(seed, std::string(GetParam()));
    test::cover(rig, {3}, 13.0, 60.0);
    const test::Flown flown = test::flyHover(rig);
    EXPECT_EQ(flown.outcome, "landed") << "seed " << seed;
    for (const int i : {1, 2}) {
      const CameraEstimate& estimate = flown.last.cameras[static_cast<std::size_t>(i)].estimate;
      const CameraError error =
          cameraError(estimate.camera_from_world, trueCameraFromWorld(rig, cameraId(i)));
      if (should_converge) {
        EXPECT_EQ(estimate.status, CameraStatus::kCalibrated) << "seed " << seed << ", camera " << i;
        EXPECT_LT(error.position, 0.01) << "seed " << seed << ", camera " << i;
        EXPECT_GT(flown.score.selectedShare(cameraId(i)), 0.5) << "seed " << seed << ", camera " << i;
      }
      if (estimate.status == CameraStatus::kCalibrated) {
        EXPECT_LT(error.position, 0.06) << "seed " << seed << ", camera " << i;
      } else {
        EXPECT_EQ(flown.score.selectedShare(cameraId(i)), 0.0) << "seed " << seed << ", camera " << i;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(CameraCalibration, TwoCamerasAtOnce,
                         testing::ValuesIn(calibratorNames().begin(), calibratorNames().end()),
                         [](const auto& each) {
                           std::string name(each.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

/// With the given cameras covered the two fly it, but neither learns from the other.
TEST(CameraCalibration, CamerasTaughtInFlightDoNotTeachEachOther) {
  RigConfig rig = twoGuessed(3, "growing-gauss-newton");
  test::cover(rig, {0, 3}, 9.0, 60.0);
  LockStep flight(rig, loadPlan(planPath("hover")));
  OperatorCommands commands;
  std::array<CameraEstimate, 2> before;
  for (;;) {
    const EngineSnapshot& now = flight.tick(commands);
    commands.arm = commands.take_off = now.phase == FlightPhase::kIdle && now.failing_checks == 0;
    if (toSeconds(now.time) < 9.2) before = {now.cameras[1].estimate, now.cameras[2].estimate};
    if (toSeconds(now.time) < 12.0) continue;
    EXPECT_TRUE(now.pose_known);
    for (const std::size_t i : {1U, 2U}) {
      EXPECT_EQ(now.cameras[i].estimate.status, CameraStatus::kCalibrated);
      EXPECT_GT(now.cameras[i].track.selected_count, 2);
      EXPECT_EQ(now.cameras[i].estimate.camera_from_world.translation,
                before[i - 1].camera_from_world.translation);
      EXPECT_EQ(now.cameras[i].estimate.covariance, before[i - 1].covariance);
    }
    break;
  }
}

TEST(CameraCalibration, UnknownMethodsAreRefusedWithTheKnownOnes) {
  try {
    LockStep flight(guessedRig(1, "guesswork"), FlightPlan{});
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInput);
    EXPECT_NE(std::string(error.what()).find("particle-filter"), std::string::npos);
  }
}

}  // namespace
}  // namespace helical
