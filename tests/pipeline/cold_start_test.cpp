// Rigs of which no camera is known, or one: the helicopter in somebody's hands calibrates them, then flies.

#include <gtest/gtest.h>

#include "engine/config/plan_file.h"
#include "engine/config/resource_files.h"
#include "engine/config/rig_file.h"
#include "engine/geometry/rotation.h"
#include "tests/pipeline/flight_fixture.h"

namespace helical {
namespace {

constexpr double kPutDownS = 1.5;  // after it was carried

/// Without the poses of these cameras, which the simulator alone knows then.
void forget(RigConfig& rig, const std::vector<std::size_t>& cameras) {
  for (const std::size_t camera : cameras) {
    auto& truth = rig.simulation.true_camera_from_world[camera];
    if (!truth) truth = rig.cameras[camera].camera_from_world;
    rig.cameras[camera].camera_from_world.reset();
  }
}

FlightPlan carriedPlan() {
  FlightPlan plan = loadPlan(planPath("carried"));
  plan.land_at_s = 8.0;
  return plan;
}

/// The state after the flight, or after `longest_s`.
EngineSnapshot fly(LockStep& flight, const FlightPlan& plan, double longest_s) {
  EngineSnapshot now;
  OperatorCommands commands;
  bool ordered = false;
  do {
    now = flight.tick(commands);
    const bool put_down = toSeconds(now.time) > plan.carried_s + kPutDownS;
    commands.arm = commands.take_off = !ordered && now.failing_checks == 0 && put_down;
    ordered = ordered || commands.take_off;
  } while (toSeconds(now.time) < longest_s && !(now.phase == FlightPhase::kOff && now.verdict.at_rest));
  return now;
}

void expectFoundAndLanded(const EngineSnapshot& end, std::uint64_t seed) {
  EXPECT_EQ(end.phase, FlightPhase::kOff) << "seed " << seed;
  EXPECT_FALSE(end.verdict.crashed) << end.verdict.reason << ", seed " << seed;
  EXPECT_TRUE(end.verdict.has_flown) << "seed " << seed;
  for (int i = 0; i < end.camera_count; ++i) {
    const CameraSnapshot& camera = end.cameras[static_cast<std::size_t>(i)];
    const CameraError error = cameraError(camera.estimate.camera_from_world, camera.true_camera_from_world);
    EXPECT_EQ(camera.estimate.status, CameraStatus::kCalibrated) << "camera " << i + 1 << ", seed " << seed;
    EXPECT_LT(error.position, 0.02) << "camera " << i + 1 << ", seed " << seed;
    EXPECT_LT(error.orientation, toRadians(0.5)) << "camera " << i + 1 << ", seed " << seed;
    EXPECT_EQ(camera.knocks_found, 0) << "camera " << i + 1 << ", seed " << seed;
  }
}

TEST(ColdStart, NoCameraIsKnownAndItFlies) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    RigConfig rig = test::shippedRig("paper", seed);
    forget(rig, {0, 1, 2});
    const FlightPlan plan = carriedPlan();
    LockStep flight(rig, plan);
    const EngineSnapshot end = fly(flight, plan, 60.0);
    expectFoundAndLanded(end, seed);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_STREQ(end.cameras[i].calibration_method, "cold-start");
  }
}

TEST(ColdStart, EightCamerasAreFoundInOneGo) {
  RigConfig rig = test::shippedRig("eight-uncalibrated", 4);
  const FlightPlan plan = carriedPlan();
  LockStep flight(rig, plan);
  expectFoundAndLanded(fly(flight, plan, 60.0), 4);
}

TEST(ColdStart, TheOneCameraThatIsKnownIsTheWorld) {
  RigConfig rig = test::shippedRig("paper", 5);
  forget(rig, {1, 2});
  const FlightPlan plan = carriedPlan();
  LockStep flight(rig, plan);
  const EngineSnapshot end = fly(flight, plan, 60.0);
  expectFoundAndLanded(end, 5);
  EXPECT_EQ(end.cameras[0].calibration_method, nullptr);
}

TEST(ColdStart, AHelicopterThatOnlyStandsThereDecidesNothing) {
  RigConfig rig = test::shippedRig("paper", 6);
  forget(rig, {0, 1, 2});
  FlightPlan plan = carriedPlan();
  plan.carried_s = 0.0;
  LockStep flight(rig, plan);
  const EngineSnapshot end = fly(flight, plan, 8.0);
  EXPECT_FALSE(end.pose_known);
  EXPECT_NE(end.cold_start, nullptr);
  EXPECT_EQ(end.phase, FlightPhase::kIdle);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NE(end.cameras[i].estimate.status, CameraStatus::kCalibrated);
}

TEST(ColdStart, RepeatsToTheLastBit) {
  RigConfig rig = test::shippedRig("paper", 7);
  forget(rig, {0, 1, 2});
  const FlightPlan plan = carriedPlan();
  std::array<EngineSnapshot, 2> ends;
  for (EngineSnapshot& end : ends) {
    LockStep flight(rig, plan);
    end = fly(flight, plan, 30.0);
  }
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(ends[0].cameras[i].estimate.camera_from_world.translation,
              ends[1].cameras[i].estimate.camera_from_world.translation);
}

}  // namespace
}  // namespace helical
