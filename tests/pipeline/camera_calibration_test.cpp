#include "engine/pipeline/camera_calibration.h"

#include <gtest/gtest.h>

#include "engine/base/error.h"
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
  for (const char* method : {"particle-filter", "growing-gauss-newton"}) {
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

TEST(CameraCalibration, WhatDoesNotConvergeIsNotFlownOn) {
  const test::Flown flown = test::flyHover(guessedRig(1, "particle-filter-literal"));
  EXPECT_EQ(flown.outcome, "landed");
  EXPECT_NE(flown.last.cameras[2].estimate.status, CameraStatus::kCalibrated);
  EXPECT_EQ(flown.score.selectedShare(cameraId(2)), 0.0);
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
