// Cameras that are knocked in flight, given and learnt ones: found, taken out, taught anew, let in again.

#include <gtest/gtest.h>

#include "engine/config/plan_file.h"
#include "engine/config/resource_files.h"
#include "engine/geometry/rotation.h"
#include "engine/pipeline/first_guess.h"
#include "tests/pipeline/flight_fixture.h"

namespace helical {
namespace {

constexpr double kKnockS = 10.0;

RigConfig knocked(const char* rig_name, std::uint64_t seed, int camera, double degrees, double metres) {
  RigConfig rig = test::shippedRig(rig_name, seed);
  rig.simulation.bumps = {{cameraId(camera), kKnockS, toRadians(degrees), metres}};
  giveFirstGuesses(rig, toRadians(15.0), 0.4, seed, true);
  return rig;
}

CameraError errorOf(const CameraSnapshot& camera) {
  return cameraError(camera.estimate.camera_from_world, camera.true_camera_from_world);
}

void expectHealed(const test::Flown& flown, int camera, int cameras, std::uint64_t seed) {
  EXPECT_EQ(flown.outcome, "landed") << "seed " << seed;
  for (int i = 0; i < cameras; ++i) {
    const CameraSnapshot& now = flown.last.cameras[static_cast<std::size_t>(i)];
    EXPECT_EQ(now.knocks_found, i == camera ? 1 : 0) << "camera " << i + 1 << ", seed " << seed;
    EXPECT_EQ(now.estimate.status, CameraStatus::kCalibrated) << "camera " << i + 1 << ", seed " << seed;
  }
  const CameraError error = errorOf(flown.last.cameras[static_cast<std::size_t>(camera)]);
  EXPECT_LT(error.position, 0.01) << "seed " << seed;
  EXPECT_LT(error.orientation, toRadians(0.5)) << "seed " << seed;
}

TEST(Knock, ACalibratedCameraHeals) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
    expectHealed(test::flyHover(knocked("calibrated", seed, 1, 5.0, 0.05)), 1, 3, seed);
}

TEST(Knock, ACameraThatLearntHealsAndSoDoesAGivenOneBesideIt) {
  for (const int camera : {0, 2})
    expectHealed(test::flyHover(knocked("paper", 2, camera, 5.0, 0.05)), camera, 3, 2);
}

TEST(Knock, OneAfterTheOtherHeal) {
  RigConfig rig = knocked("calibrated", 3, 0, 2.0, 0.03);
  rig.simulation.bumps.push_back({cameraId(2), kKnockS + 4.0, toRadians(3.0), 0.02});
  const test::Flown flown = test::flyHover(rig);
  EXPECT_EQ(flown.outcome, "landed");
  for (const int camera : {0, 2}) {
    const CameraSnapshot& now = flown.last.cameras[static_cast<std::size_t>(camera)];
    EXPECT_EQ(now.knocks_found, 1) << "camera " << camera + 1;
    EXPECT_EQ(now.estimate.status, CameraStatus::kCalibrated) << "camera " << camera + 1;
    EXPECT_LT(errorOf(now).position, 0.02) << "camera " << camera + 1;
  }
}

TEST(Knock, IsFoundBeforeItHarms) {
  const RigConfig rig = knocked("calibrated", 1, 1, 5.0, 0.05);
  LockStep flight(rig, loadPlan(planPath("hover")));
  OperatorCommands commands;
  double found_s = -1.0, worst = 0.0;
  for (;;) {
    const EngineSnapshot& now = flight.tick(commands);
    commands.arm = commands.take_off = now.phase == FlightPhase::kIdle && now.failing_checks == 0;
    const double time = toSeconds(now.time);
    if (found_s < 0.0 && now.cameras[1].knocks_found == 1) {
      found_s = time;
      EXPECT_EQ(now.cameras[1].estimate.status, CameraStatus::kRejected);
    }
    if (time > 9.0)
      worst = std::max(
          worst,
          (now.tracked.state.world_from_body.translation - now.truth.world_from_body.translation).norm());
    if (time > kKnockS + 2.0) break;
  }
  EXPECT_GT(found_s, kKnockS);
  EXPECT_LT(found_s, kKnockS + 0.25);
  EXPECT_LT(worst, 0.02);
}

TEST(Knock, OfTwoCamerasThatDisagreeNoneIsNamedAndItFliesOn) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    RigConfig rig = test::shippedRig("calibrated", seed);
    rig.cameras.pop_back();
    rig.simulation.true_camera_from_world.resize(2);
    rig.simulation.bumps = {{cameraId(0), kKnockS, toRadians(5.0), 0.05}};
    const test::Flown flown = test::flyHover(rig);
    EXPECT_EQ(flown.outcome, "landed") << "seed " << seed;
    EXPECT_TRUE(flown.last.cameras_disagree) << "seed " << seed;
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(flown.last.cameras[i].knocks_found, 0) << "seed " << seed;
      EXPECT_NE(flown.last.cameras[i].estimate.status, CameraStatus::kRejected) << "seed " << seed;
    }
  }
}

TEST(Knock, WhileTwoCamerasDisagreeItDoesNotArm) {
  RigConfig rig = test::shippedRig("calibrated", 3);
  rig.cameras.pop_back();
  rig.simulation.true_camera_from_world.resize(2);
  rig.simulation.bumps = {{cameraId(0), 2.0, toRadians(5.0), 0.05}};
  rig.safety.arm_cameras = 1.0;
  LockStep flight(rig, loadPlan(planPath("hover")));
  bool could_arm = false;
  for (;;) {
    const EngineSnapshot& now = flight.tick({});
    if (now.cameras_disagree) break;
    could_arm = could_arm || now.failing_checks == 0;
    ASSERT_LT(toSeconds(now.time), 10.0);
  }
  EXPECT_TRUE(could_arm);
  const auto standing = [&] {
    for (int i = 0; i < 300; ++i) flight.tick({});
    return flight.tick({}).failing_checks;
  };
  EXPECT_EQ(standing(), bitOf(PreArmCheck::kResidual)) << "it stands still before the other camera";
  const bool first_was = flight.tick({}).cameras[0].estimate.status != CameraStatus::kCalibrated;
  flight.hideCamera(cameraId(first_was ? 0 : 1), true);
  EXPECT_EQ(standing(), 0u) << "the operator hid the camera that was set aside";
}

TEST(Knock, NoFalseAlarmsWithTenPerCentOutliers) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    RigConfig rig = test::shippedRig("calibrated", seed);
    rig.simulation.noise.outliers = 0.1;
    const test::Flown flown = test::flyHover(rig);
    EXPECT_EQ(flown.outcome, "landed") << "seed " << seed;
    for (int i = 0; i < 3; ++i)
      EXPECT_EQ(flown.last.cameras[static_cast<std::size_t>(i)].knocks_found, 0) << "seed " << seed;
  }
}

}  // namespace
}  // namespace helical
