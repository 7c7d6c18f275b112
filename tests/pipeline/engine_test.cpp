// The engine in real time, in its own threads. Runs under the thread sanitizer too.

#include "engine/pipeline/engine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <string>
#include <thread>

#include "engine/base/error.h"
#include "engine/config/plan_file.h"
#include "engine/config/resource_files.h"
#include "engine/pipeline/first_guess.h"
#include "tests/pipeline/engine_waiting.h"
#include "tests/pipeline/flight_fixture.h"

namespace helical {
namespace {

using namespace std::chrono_literals;

bool hasEvent(Engine& engine, const std::string& text) {
  EngineEvent event;
  while (engine.nextEvent(event))
    if (text == event.text.data()) return true;
  return false;
}

TEST(Engine, FliesHidesACameraAndIsKilled) {
  Engine engine(test::shippedRig("paper", 4), loadPlan(planPath("hover")));
  EXPECT_FALSE(engine.running());
  engine.start();
  EXPECT_TRUE(engine.running());
  ASSERT_TRUE(waitUntil(engine, [](const auto& now) { return now.pose_known && now.failing_checks == 0; }));
  engine.takeOff();
  ASSERT_TRUE(
      waitUntil(engine, [](const auto& now) { return now.tick > 0 && now.phase == FlightPhase::kIdle; }));
  engine.arm();
  ASSERT_TRUE(waitUntil(engine, [](const auto& now) { return now.armed; }));
  engine.takeOff();
  ASSERT_TRUE(waitUntil(engine, [](const auto& now) { return now.phase == FlightPhase::kFlying; }));
  EXPECT_TRUE(hasEvent(engine, "Airborne"));

  engine.hideCamera(cameraId(1), true);
  ASSERT_TRUE(waitUntil(engine, [](const auto& now) {
    return now.cameras[1].hidden && now.cameras[1].track.selected_count == 0 &&
           now.cameras[0].track.selected_count == now.marker_count;
  }));
  engine.hideCamera(cameraId(1), false);
  ASSERT_TRUE(waitUntil(engine, [](const auto& now) { return now.cameras[1].track.selected_count > 0; }));

  engine.kill();
  ASSERT_TRUE(waitUntil(engine, [](const auto& now) {
    return now.safety == SafetyState::kCut && now.sticks == StickDemand{};
  }));
  engine.arm();
  engine.takeOff();
  ASSERT_TRUE(waitUntil(engine, [tick = std::uint64_t{0}](const auto& now) mutable {
    if (tick == 0) tick = now.tick;
    EXPECT_EQ(now.sticks, StickDemand{});
    return now.tick > tick + 20;
  }));
  engine.stop();
  EXPECT_FALSE(engine.running());
}

TEST(Engine, ObeysWhatTheOperatorChangesInFlight) {
  FlightPlan plan = loadPlan(planPath("hover"));
  plan.land_at_s = 0.0;
  plan.waypoints.front().hold_s = 1e6;
  Engine engine(test::shippedRig("paper", 4), plan);
  engine.start();
  ASSERT_TRUE(waitUntil(engine, [](const auto& now) { return now.pose_known; }));

  engine.loseFrames(cameraId(1), 0.5);
  engine.addNoise(cameraId(2), 0.0, 2.0);
  ASSERT_TRUE(waitUntil(engine, [](const auto& now) {
    return now.cameras[1].lost_share == 0.5 && now.cameras[1].dropped > 5 && now.cameras[2].noise == 2.0;
  }));
  EXPECT_EQ(engine.snapshot().cameras[0].dropped, 0U);
  engine.loseFrames(cameraId(1), 0.0);
  engine.addNoise(cameraId(2), 0.0, 0.0);

  plan.waypoints.front().position_above_pad.z() = 0.45;
  ControllerOptions control = engine.control();
  control.yaw_p = 1.0;
  engine.change({plan, {}});
  engine.change({{}, control});  // at once after: neither is lost
  ASSERT_TRUE(waitUntil(engine, [](const auto& now) { return now.plans >= 1 && now.controls >= 1; }));
  EXPECT_EQ(engine.control().yaw_p, 1.0);
  EXPECT_EQ(engine.plan().waypoints.front().position_above_pad.z(), 0.45);
  control.yaw_p = 50.0;
  EXPECT_THROW(engine.change({plan, control}), Error);
  EXPECT_EQ(engine.control().yaw_p, 1.0);

  ASSERT_TRUE(waitUntil(engine, [](const auto& now) { return now.pose_known && now.failing_checks == 0; }));
  engine.arm();
  engine.takeOff();
  ASSERT_TRUE(waitUntil(engine, [](const auto& now) { return now.hovering; }));
  EXPECT_NEAR(engine.snapshot().set_point.position_in_world.z() - engine.snapshot().pad_height, 0.45, 0.01);
  EXPECT_THROW(engine.takeBackground(), Error) << "not in flight";
  engine.kill();
}

TEST(Engine, ASilentReaderCostsItNothing) {
  Engine engine(test::shippedRig("paper", 4), loadPlan(planPath("hover")));
  engine.start();
  ASSERT_TRUE(waitUntil(engine, [](const auto& now) { return now.tick > 10; }));
  const std::uint64_t before = engine.snapshot().tick;
  while (engine.lostTicks() == 0) std::this_thread::sleep_for(10ms);  // the queue of ticks overflows
  ASSERT_TRUE(engine.poll());
  EXPECT_GT(engine.snapshot().tick, before + 200);
}

TEST(Engine, TheMethodChangesInFlightAndItsParticlesAreSeen) {
  RigConfig rig = test::shippedRig("paper", 4);
  rig.calibrator = "particle-filter";
  giveFirstGuesses(rig, 0.26, 0.4, 4, false);
  Engine engine(rig, loadPlan(planPath("hover")));
  engine.start();
  const auto method_is = [](const EngineSnapshot& now, const std::string& name) {
    return now.cameras[2].calibration_method != nullptr && name == now.cameras[2].calibration_method;
  };
  ASSERT_TRUE(waitUntil(engine, [&](const EngineSnapshot& now) {
    return now.cameras[2].estimate.status == CameraStatus::kCalibrated && method_is(now, "particle-filter");
  }));
  ASSERT_TRUE(waitUntil(engine, [&](const EngineSnapshot& now) {
    return engine.pollCalibration(cameraId(2)) && engine.calibration(cameraId(2)).count > 100 &&
           now.cameras[2].effective_sample_size > 1.0;
  }));
  const CalibrationView& view = engine.calibration(cameraId(2));
  EXPECT_GE(view.total, view.count);
  const RigidTransform truth = engine.snapshot().cameras[2].true_camera_from_world;
  float heaviest = 0.0F;
  for (int i = 0; i < view.count; ++i) {
    const auto& particle = view.particles[static_cast<std::size_t>(i)];
    EXPECT_LT((particle.centre_in_world.cast<double>() - truth.inverseTranslation()).norm(), 0.2);
    heaviest = std::max(heaviest, particle.weight);
  }
  EXPECT_EQ(heaviest, 1.0F);

  engine.setCalibrator("gauss-newton");
  EXPECT_EQ(engine.calibrator(), "gauss-newton");
  ASSERT_TRUE(waitUntil(engine, [&](const EngineSnapshot& now) { return method_is(now, "gauss-newton"); }));
  EXPECT_TRUE(hasEvent(engine, "Camera 3: calibrates anew by gauss-newton"));
  ASSERT_TRUE(waitUntil(engine, [&](const EngineSnapshot&) {
    return engine.pollCalibration(cameraId(2)) && engine.calibration(cameraId(2)).total == 0;
  })) << "this method has no particles";
  EXPECT_THROW(engine.setCalibrator("crystal-ball"), Error);
  EXPECT_EQ(engine.calibrator(), "gauss-newton");
  // Faster than the flight thread can take them: the last one counts.
  for (int i = 0; i < 20; ++i) engine.setCalibrator("growing-gauss-newton");
  engine.setCalibrator("particle-filter");
  ASSERT_TRUE(
      waitUntil(engine, [&](const EngineSnapshot& now) { return method_is(now, "particle-filter"); }));
  EXPECT_TRUE(engine.snapshot().pose_known);
}

TEST(Engine, ABoardCoversACameraAndAKnockMovesIt) {
  Engine engine(test::shippedRig("paper", 4), loadPlan(planPath("hover")));
  engine.start();
  ASSERT_TRUE(waitUntil(
      engine, [](const auto& now) { return now.cameras[1].track.selected_count == now.marker_count; }));
  WhiteBoards boards;
  boards.count = 1;
  boards.boards[0].count = 4;
  boards.boards[0].corners = {Eigen::Vector2d{-10, -10}, {700, -10}, {700, 500}, {-10, 500}};
  engine.setBoards(cameraId(1), boards);
  ASSERT_TRUE(waitUntil(engine, [](const auto& now) {
    return now.cameras[1].boards == 1 && now.cameras[1].centroids == 0 && now.cameras[0].centroids > 0;
  }));
  EXPECT_TRUE(hasEvent(engine, "Camera 2: a white board is held before it"));
  engine.setBoards(cameraId(1), {});
  ASSERT_TRUE(
      waitUntil(engine, [](const auto& now) { return now.cameras[1].centroids == now.marker_count; }));

  const RigidTransform before = engine.snapshot().cameras[0].true_camera_from_world;
  engine.knockCamera(cameraId(0), 0.1, 0.05);
  ASSERT_TRUE(waitUntil(engine, [&](const auto& now) {
    return !now.cameras[0].true_camera_from_world.rotation.isApprox(before.rotation, 1e-3);
  }));
  EXPECT_TRUE(hasEvent(engine, "Camera 1: knocked by the operator"));
}

TEST(Engine, StopsWithoutEverHavingStarted) {
  Engine engine(test::shippedRig("paper", 4), FlightPlan{});
  engine.stop();
  EXPECT_FALSE(engine.running());
}

}  // namespace
}  // namespace helical
