#include "engine/session/recorder.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <map>

#include "engine/base/error.h"
#include "engine/pipeline/engine.h"
#include "engine/pipeline/lock_step.h"
#include "tests/session/session_fixture.h"

namespace helical {
namespace {

using test::TemporaryFolder;

constexpr int kTicks = 900;  // 15 s: take-off and hover

struct Flown {
  std::vector<StickDemand> sticks;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

Flown fly(const SessionSettings& settings, FlightTap* tap) {
  LockStep flight(settings.rig, settings.plan, tap);
  Flown flown;
  OperatorCommands commands;
  for (int i = 0; i < kTicks; ++i) {
    commands.arm = commands.take_off = i == 60;
    const EngineSnapshot& now = flight.tick(commands);
    flown.sticks.push_back(now.sticks);
    flown.position = now.truth.world_from_body.translation;
  }
  return flown;
}

std::map<std::string, int> countsOf(const std::filesystem::path& file) {
  McapReader reader(file);
  std::map<std::string, int> counts;
  reader.read([&](const McapMessage& message) { ++counts[reader.channels().at(message.channel).topic]; });
  return counts;
}

TEST(Recorder, RecordingDoesNotChangeTheFlight) {
  const TemporaryFolder folder;
  const SessionSettings settings = test::hoverSettings(5);
  const Flown alone = fly(settings, nullptr);
  Recorder recorder(folder / "a.mcap", settings, Recorder::WhenFull::kWait);
  const Flown recorded = fly(settings, &recorder);
  recorder.finish();
  EXPECT_EQ(alone.sticks, recorded.sticks);
  EXPECT_EQ(alone.position, recorded.position);
}

TEST(Recorder, WritesEveryTickAndEveryObservationOnce) {
  const TemporaryFolder folder;
  const SessionSettings settings = test::hoverSettings(5);
  Recorder recorder(folder / "a.mcap", settings, Recorder::WhenFull::kWait);
  fly(settings, &recorder);
  recorder.finish();
  EXPECT_EQ(recorder.lost(), 0u);
  EXPECT_FALSE(recorder.failed());
  McapReader reader(folder / "a.mcap");
  EXPECT_TRUE(reader.complete());
  const auto counts = countsOf(folder / "a.mcap");
  EXPECT_EQ(counts.at("/flight/state"), kTicks);
  EXPECT_EQ(counts.at("/sticks"), kTicks);
  EXPECT_GT(counts.at("/events"), 2);
  for (const char* camera : {"1", "2", "3"}) {
    const std::string topic = std::string("/cameras/") + camera;
    EXPECT_NEAR(counts.at(topic + "/observation"), kTicks, 5);
    EXPECT_EQ(counts.at(topic + "/camera_info"), 1);
  }
}

TEST(Recorder, AFullDiskEndsTheRecordAndNotTheFlight) {
  const TemporaryFolder folder;
  const SessionSettings settings = test::hoverSettings(5);
  const Flown alone = fly(settings, nullptr);
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  Recorder recorder(folder / "a.mcap", settings, Recorder::WhenFull::kWait);
  const rlimit small{200000, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const Flown recorded = fly(settings, &recorder);
  recorder.finish();
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_EQ(alone.sticks, recorded.sticks);
  ASSERT_TRUE(recorder.failed());
  EXPECT_NE(recorder.failure().find("a.mcap"), std::string::npos);
  EXPECT_LE(std::filesystem::file_size(folder / "a.mcap"), 200000u);
  McapReader reader(folder / "a.mcap");
  EXPECT_FALSE(reader.complete());
  const auto reading = reader.read([](const McapMessage&) {});
  EXPECT_EQ(reading.damaged_chunks, 0u);
}

TEST(Recorder, AFlightInRealTimeIsRecordedFromItsOwnThread) {
  const TemporaryFolder folder;
  const SessionSettings settings = test::hoverSettings(5);
  Recorder recorder(folder / "a.mcap", settings, Recorder::WhenFull::kDrop);
  std::uint64_t ticks = 0;
  {
    Engine engine(settings.rig, settings.plan, &recorder);
    engine.start();
    engine.hideCamera(cameraId(1), true);
    while (ticks < 30)
      if (engine.poll()) ticks = engine.snapshot().tick;
    engine.stop();
    ASSERT_TRUE(engine.poll() || ticks > 0);
    ticks = engine.snapshot().tick;
  }
  recorder.finish();
  const auto counts = countsOf(folder / "a.mcap");
  EXPECT_EQ(static_cast<std::uint64_t>(counts.at("/flight/state")) + recorder.lost(), ticks);
  EXPECT_EQ(counts.at("/flight/orders"), 1);
}

TEST(Recorder, AFileThatCannotBeMadeIsAnErrorBeforeTheFlight) {
  const SessionSettings settings = test::hoverSettings(5);
  EXPECT_THROW(Recorder("/no/such/folder/a.mcap", settings, Recorder::WhenFull::kDrop), Error);
}

}  // namespace
}  // namespace helical
