// The engine in real time, in its own threads. Runs under the thread sanitizer too.

#include "engine/pipeline/engine.h"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <string>
#include <thread>

#include "engine/config/plan_file.h"
#include "engine/config/resource_files.h"
#include "tests/pipeline/flight_fixture.h"

namespace helical {
namespace {

using namespace std::chrono_literals;

/// Reads the engine until `condition` holds; generous, for slow and busy machines.
bool waitUntil(Engine& engine, const std::function<bool(const EngineSnapshot&)>& condition) {
  const auto give_up = std::chrono::steady_clock::now() + 120s;
  while (std::chrono::steady_clock::now() < give_up) {
    if (engine.poll() && condition(engine.snapshot())) return true;
    std::this_thread::sleep_for(2ms);
  }
  return false;
}

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
  ASSERT_TRUE(waitUntil(engine, [](const auto& now) { return now.pose_known; }));
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
  engine.takeOff();
  ASSERT_TRUE(waitUntil(engine, [tick = std::uint64_t{0}](const auto& now) mutable {
    if (tick == 0) tick = now.tick;
    EXPECT_EQ(now.sticks, StickDemand{});
    return now.tick > tick + 20;
  }));
  engine.stop();
  EXPECT_FALSE(engine.running());
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

TEST(Engine, PicturesComeWithWhatWasFoundInThem) {
  RigConfig rig = test::shippedRig("paper", 4);
  rig.simulation.images = true;
  Engine engine(rig, loadPlan(planPath("hover")));
  engine.start();
  bool seen = false;
  ASSERT_TRUE(waitUntil(engine, [&](const EngineSnapshot&) {
    for (int c = 0; c < 3; ++c)
      if (engine.pollPicture(cameraId(c)) && engine.picture(cameraId(c)).observation.count == 4) seen = true;
    return seen;
  }));
  const CameraPicture& picture = engine.picture(cameraId(0));
  EXPECT_EQ(picture.width, 640);
  EXPECT_EQ(picture.bgr.size(), 640u * 480u * 3u);
}

TEST(Engine, StopsWithoutEverHavingStarted) {
  Engine engine(test::shippedRig("paper", 4), FlightPlan{});
  engine.stop();
  EXPECT_FALSE(engine.running());
}

}  // namespace
}  // namespace helical
