#include "engine/session/fork.h"

#include <gtest/gtest.h>

#include "engine/base/error.h"
#include "engine/pipeline/first_guess.h"
#include "engine/pipeline/lock_step.h"
#include "engine/session/recorder.h"
#include "engine/session/replay.h"
#include "tests/session/session_fixture.h"

namespace helical {
namespace {

using test::TemporaryFolder;

constexpr int kTicks = 900;

/// `flown` by the simulator, recorded as a flight by `written`.
void record(const std::filesystem::path& file, const SessionSettings& flown, const SessionSettings& written,
            int ticks = kTicks) {
  Recorder recorder(file, written, Recorder::WhenFull::kWait);
  LockStep flight(flown.rig, flown.plan, &recorder);
  OperatorCommands commands;
  for (int i = 0; i < ticks; ++i) {
    commands.arm = commands.take_off = i == 60;
    if (i == 300) flight.hideCamera(cameraId(2), true);
    if (i == 330) flight.hideCamera(cameraId(2), false);
    flight.tick(commands);
  }
}

void record(const std::filesystem::path& file, const SessionSettings& settings, int ticks = kTicks) {
  record(file, settings, settings, ticks);
}

Fork fork(const std::filesystem::path& file, const ForkChanges& changes) {
  McapReader session(file);
  const SessionSettings settings = fromAttachments(session.attachments(), file.string());
  return forkSession(
      session, settings, changes, [](const EngineSnapshot&) {},
      [](const EngineSnapshot& now) { return now.tick >= kTicks; });
}

TEST(Fork, WithoutChangesItIsTheSameFlight) {
  const TemporaryFolder folder;
  SessionSettings settings = test::hoverSettings(41);
  giveFirstGuesses(settings.rig, 0.26, 0.4, 41, false);
  record(folder / "a.mcap", settings);
  const Fork same = fork(folder / "a.mcap", {.at_s = 9.0, .occlusions = {}, .calibrator = {}});
  EXPECT_GT(same.ticks_before, 500u);
  EXPECT_EQ(same.different_before, 0u);
  EXPECT_FALSE(same.last.verdict.crashed);
  McapReader session(folder / "a.mcap");
  const Replay replay =
      replaySession(session, fromAttachments(session.attachments(), "a"), {}, [](const EngineSnapshot&) {});
  EXPECT_EQ(same.last.sticks, replay.last.sticks);
  EXPECT_EQ(same.last.truth.world_from_body.translation, replay.last.truth.world_from_body.translation);
}

TEST(Fork, CoveredCamerasBringItDownInTheWorldItself) {
  const TemporaryFolder folder;
  record(folder / "a.mcap", test::hoverSettings(42));
  ForkChanges changes;
  changes.at_s = 9.0;
  for (int c = 0; c < 3; ++c) changes.occlusions.push_back({cameraId(c), 9.0, 100.0});
  const Fork blind = fork(folder / "a.mcap", changes);
  EXPECT_EQ(blind.different_before, 0u);
  EXPECT_GT(blind.score.lostSeconds(), 1.0);
  EXPECT_NE(blind.last.failsafes, 0u);
  EXPECT_LT(blind.last.truth.world_from_body.translation.z(), 0.4);
}

TEST(Fork, AnotherCalibratorTakesOverThere) {
  const TemporaryFolder folder;
  SessionSettings settings = test::hoverSettings(43);
  giveFirstGuesses(settings.rig, 0.26, 0.4, 43, false);
  record(folder / "a.mcap", settings);
  const Fork other = fork(folder / "a.mcap", {.at_s = 9.0, .occlusions = {}, .calibrator = "ekf"});
  EXPECT_EQ(other.different_before, 0u);
  EXPECT_STREQ(other.last.cameras[2].calibration_method, "ekf");
}

TEST(Fork, WhatCannotBeIsRefused) {
  const TemporaryFolder folder;
  SessionSettings settings = test::hoverSettings(44);
  record(folder / "a.mcap", settings, 120);
  EXPECT_THROW(fork(folder / "a.mcap", {.at_s = 50.0, .occlusions = {}, .calibrator = {}}), Error);
  EXPECT_THROW(
      fork(folder / "a.mcap", {.at_s = 1.0, .occlusions = {{cameraId(0), 0.5, 2.0}}, .calibrator = {}}),
      Error);
  settings.rig.cameras[0].source = "webcam:/dev/video0";
  McapReader session(folder / "a.mcap");
  EXPECT_THROW(forkSession(
                   session, settings, {.at_s = 1.0, .occlusions = {}, .calibrator = {}},
                   [](const EngineSnapshot&) {}, [](const EngineSnapshot&) { return true; }),
               Error);
}

/// What differs from a flight in real time is when its threads ran.
SessionSettings asInRealTime(std::uint64_t seed) {
  SessionSettings settings = test::hoverSettings(seed);
  settings.realtime = true;
  return settings;
}

TEST(ForkInRealTime, TheLoopRepeatsItselfAndTheWorldIsWhereItWas) {
  const TemporaryFolder folder;
  const SessionSettings settings = asInRealTime(45);
  record(folder / "a.mcap", test::hoverSettings(45), settings);
  std::vector<EngineSnapshot> ticks;
  McapReader session(folder / "a.mcap");
  const Fork same = forkSession(
      session, settings, {.at_s = 9.0, .occlusions = {}, .calibrator = {}},
      [&](const EngineSnapshot& now) { ticks.push_back(now); },
      [](const EngineSnapshot& now) { return now.tick >= kTicks; });
  EXPECT_GT(same.ticks_before, 500u);
  EXPECT_EQ(same.different_before, 0u);
  ASSERT_EQ(ticks.size(), static_cast<std::size_t>(kTicks));
  const EngineSnapshot& before = ticks[same.ticks_before - 1];
  const EngineSnapshot& after = ticks[same.ticks_before];
  EXPECT_GT(before.truth.world_from_body.translation.z(), 0.5);
  const Eigen::Vector3d expected = before.truth.world_from_body.translation +
                                   toSeconds(after.time - before.time) * before.truth.velocity_in_world;
  EXPECT_LT((after.truth.world_from_body.translation - expected).norm(), 1e-3) << "no jump at the fork";
  EXPECT_FALSE(same.last.verdict.crashed);
  EXPECT_LT((same.last.truth.world_from_body.translation - same.last.set_point.position_in_world).norm(), 0.1)
      << "it flies on as well as it did";
}

TEST(ForkInRealTime, CoveredCamerasBringItDown) {
  const TemporaryFolder folder;
  record(folder / "a.mcap", test::hoverSettings(46), asInRealTime(46));
  ForkChanges changes;
  changes.at_s = 9.0;
  for (int c = 0; c < 3; ++c) changes.occlusions.push_back({cameraId(c), 9.0, 100.0});
  const Fork blind = fork(folder / "a.mcap", changes);
  EXPECT_EQ(blind.different_before, 0u);
  EXPECT_NE(blind.last.failsafes, 0u);
  EXPECT_LT(blind.last.truth.world_from_body.translation.z(), 0.4);
}

TEST(Replay, TwentySessionsComeOutTheSameBitForBit) {
  const TemporaryFolder folder;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SessionSettings settings = test::hoverSettings(200 + seed);
    settings.rig.calibrator = seed % 2 == 0 ? "joint" : "particle-filter";
    settings.rig.simulation.vary = 0.02 * static_cast<double>(seed);
    giveFirstGuesses(settings.rig, 0.26, 0.4, seed, false);
    record(folder / "a.mcap", settings, 500);
    McapReader session(folder / "a.mcap");
    const Replay replay =
        replaySession(session, fromAttachments(session.attachments(), "a"), {}, [](const EngineSnapshot&) {});
    EXPECT_EQ(replay.ticks, 500u);
    EXPECT_EQ(replay.different_ticks, 0u) << "seed " << seed << ", first at " << replay.first_difference_s;
    EXPECT_EQ(replay.missing, 0u);
  }
}

}  // namespace
}  // namespace helical
