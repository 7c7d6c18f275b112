#include "engine/session/replay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <thread>

#include "engine/base/error.h"
#include "engine/pipeline/engine.h"
#include "engine/pipeline/first_guess.h"
#include "engine/pipeline/lock_step.h"
#include "engine/session/mcap_recovery.h"
#include "engine/session/recorder.h"
#include "tests/session/session_fixture.h"

namespace helical {
namespace {

using test::TemporaryFolder;

constexpr int kTicks = 900;  // 15 s: take-off and hover

/// Flies and records; `before_tick` gives the operator's orders. The last state.
EngineSnapshot record(const std::filesystem::path& file, const SessionSettings& settings,
                      const std::function<void(int, LockStep&)>& before_tick) {
  Recorder recorder(file, settings, Recorder::WhenFull::kWait);
  LockStep flight(settings.rig, settings.plan, &recorder);
  EngineSnapshot last;
  for (int i = 0; i < kTicks; ++i) {
    OperatorCommands commands;
    commands.arm = commands.take_off = i == 60;
    before_tick(i, flight);
    last = flight.tick(commands);
  }
  return last;
}

void record(const std::filesystem::path& file, const SessionSettings& settings) {
  record(file, settings, [](int i, LockStep& flight) {
    if (i == 500) flight.hideCamera(cameraId(1), true);
    if (i == 560) flight.hideCamera(cameraId(1), false);
  });
}

SessionSettings settingsOf(const McapReader& session) {
  return fromAttachments(session.attachments(), session.file().string());
}

Replay replayed(const std::filesystem::path& file, const ReplayChanges& changes = {}) {
  McapReader session(file);
  return replaySession(session, settingsOf(session), changes, [](const EngineSnapshot&) {});
}

TEST(Replay, ChangesOfPlanAndGainsInFlightAreRepeatedBitForBit) {
  const TemporaryFolder folder;
  const SessionSettings settings = test::hoverSettings(5);
  record(folder / "a.mcap", settings, [&](int i, LockStep& flight) {
    if (i != 500) return;
    FlightChange change{settings.plan, settings.rig.control};
    change.plan->waypoints = {{{0.1, 0.2, 0.7}, 0.1, 0.0, 1.0 / 3.0}};
    change.control->position_p = 1.2;
    change.control->trim_roll = 0.01;
    flight.change(change);
  });
  const Replay replay = replayed(folder / "a.mcap");
  EXPECT_EQ(replay.ticks, static_cast<std::uint64_t>(kTicks));
  EXPECT_EQ(replay.different_ticks, 0u) << "first at " << replay.first_difference_s;
  EXPECT_EQ(replay.missing, 0u);
  EXPECT_EQ(replay.last.plans, 1u);
  EXPECT_EQ(replay.last.controls, 1u);
  EXPECT_NEAR(replay.last.set_point.position_in_world.y(), 0.2, 1e-9);
}

TEST(Replay, TheSameSettingsGiveTheSameFlightBitForBit) {
  const TemporaryFolder folder;
  for (const char* calibrator : {"joint", "particle-filter", "ekf"}) {
    SessionSettings settings = test::hoverSettings(21);
    settings.rig.calibrator = calibrator;
    giveFirstGuesses(settings.rig, 0.26, 0.4, 21, false);
    record(folder / "a.mcap", settings);
    const Replay replay = replayed(folder / "a.mcap");
    EXPECT_EQ(replay.ticks, static_cast<std::uint64_t>(kTicks));
    EXPECT_EQ(replay.different_ticks, 0u) << calibrator << ", first at " << replay.first_difference_s;
    EXPECT_EQ(replay.missing, 0u);
    EXPECT_GT(replay.position_difference.count(), 800u);
    EXPECT_EQ(replay.position_difference.value(), 0.0);
    EXPECT_LT(replay.score.trackedPosition().value(), 0.02);
    EXPECT_GT(replay.score.trackedPosition().count(), 0u);
  }
}

TEST(Replay, WhatTheOperatorDecidedAboutCalibrationsIsDecidedAgain) {
  const TemporaryFolder folder;
  const SessionSettings settings = test::hoverSettings(24);
  record(folder / "a.mcap", settings, [&](int i, LockStep& flight) {
    CalibrationOrder order;
    order.camera = cameraId(2);
    order.kind = i == 300 ? CalibrationOrderKind::kFreeze : CalibrationOrderKind::kResume;
    if (i == 300 || i == 400) flight.orderCalibration(order);
    if (i == 500) {
      order.kind = CalibrationOrderKind::kAdopt;
      order.camera_from_world = *settings.rig.simulation.true_camera_from_world[2];
      order.camera_from_world.translation.x() += 1.0 / 300.0;
      order.covariance = 1e-5 * Matrix6d::Identity();
      flight.orderCalibration(order);
    }
    if (i == 600) {
      order.kind = CalibrationOrderKind::kRefine;
      EXPECT_EQ(flight.orderCalibration(order), nullptr);
    }
  });
  const Replay replay = replayed(folder / "a.mcap");
  EXPECT_EQ(replay.ticks, static_cast<std::uint64_t>(kTicks));
  EXPECT_EQ(replay.different_ticks, 0u) << "first at " << replay.first_difference_s;
  EXPECT_EQ(replay.missing, 0u);
}

TEST(Replay, BallsAndFocalLengthsThatWereCorrectedInFlightAreCorrectedAgain) {
  const TemporaryFolder folder;
  SessionSettings settings = test::hoverSettings(24);
  settings.rig.self_calibration = {1e-3, 0.01};
  settings.rig.simulation.marker_error_m = 1e-3;
  settings.rig.simulation.focal_error = 0.003;
  const EngineSnapshot last = record(folder / "a.mcap", settings, [](int i, LockStep& flight) {
    if (i != 600) return;
    CalibrationOrder order;
    order.kind = CalibrationOrderKind::kRefine;
    EXPECT_EQ(flight.orderCalibration(order), nullptr);
  });
  ASSERT_EQ(last.refinement.outcome, RefinementOutcome::kCorrected);
  const Replay replay = replayed(folder / "a.mcap");
  EXPECT_EQ(replay.different_ticks, 0u) << "first at " << replay.first_difference_s;
  EXPECT_EQ(replay.missing, 0u);
  EXPECT_TRUE(std::ranges::equal(replay.last.markers.all(), last.markers.all()));
  EXPECT_EQ(replay.last.cameras[0].focal_scale, last.cameras[0].focal_scale);
  EXPECT_NE(last.cameras[0].focal_scale, 1.0);
}

TEST(Replay, CoveredCamerasAnswerWhatWouldHaveBeenKnown) {
  const TemporaryFolder folder;
  record(folder / "a.mcap", test::hoverSettings(22));
  ReplayChanges changes;
  for (int camera = 0; camera < 3; ++camera) changes.occlusions.push_back({cameraId(camera), 10.0, 11.0});
  const Replay replay = replayed(folder / "a.mcap", changes);
  EXPECT_GT(replay.different_ticks, 30u);
  EXPECT_NEAR(replay.first_difference_s, 10.0, 0.1);
  EXPECT_GT(replay.score.lostSeconds(), 0.5);
}

TEST(Replay, AnotherCalibratorIsAnotherResult) {
  const TemporaryFolder folder;
  SessionSettings settings = test::hoverSettings(23);
  settings.rig.calibrator = "particle-filter";
  giveFirstGuesses(settings.rig, 0.26, 0.4, 23, false);
  record(folder / "a.mcap", settings);
  McapReader session(folder / "a.mcap");
  SessionSettings other = settingsOf(session);
  other.rig.calibrator = "ekf";
  const Replay replay = replaySession(session, other, {}, [](const EngineSnapshot&) {});
  EXPECT_STREQ(replay.last.cameras[2].calibration_method, "ekf");
}

TEST(Replay, AFlightInRealTimeRepeatsInTheOrderInWhichItHappened) {
  const TemporaryFolder folder;
  SessionSettings settings = test::hoverSettings(24);
  giveFirstGuesses(settings.rig, 0.26, 0.4, 24, false);
  settings.realtime = true;
  Recorder recorder(folder / "a.mcap", settings, Recorder::WhenFull::kDrop);
  {
    Engine engine(settings.rig, settings.plan, &recorder);
    engine.start();
    std::uint64_t ticks = 0;
    while (ticks < 150) {
      if (engine.poll()) ticks = engine.snapshot().tick;
      if (ticks == 50) {
        engine.arm();
        engine.takeOff();
      }
      if (ticks == 80) engine.setCalibrator("ekf");
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    engine.stop();
  }
  recorder.finish();
  ASSERT_EQ(recorder.lost(), 0u);
  const Replay replay = replayed(folder / "a.mcap");
  EXPECT_EQ(replay.missing, 0u);
  EXPECT_EQ(replay.different_ticks, 0u) << "first at " << replay.first_difference_s;
  EXPECT_GE(replay.ticks, 150u);
}

TEST(Replay, ACutSessionRepeatsAsFarAsItGoes) {
  const TemporaryFolder folder;
  record(folder / "a.mcap", test::hoverSettings(25));
  const std::string bytes = test::bytesOf(folder / "a.mcap");
  test::writeBytes(folder / "cut.mcap", bytes.substr(0, bytes.size() / 2));
  const Replay cut = replayed(folder / "cut.mcap");
  EXPECT_GT(cut.ticks, 100u);
  EXPECT_LT(cut.ticks, static_cast<std::uint64_t>(kTicks));
  EXPECT_EQ(cut.different_ticks, 0u);
  recoverMcap(folder / "cut.mcap");
  EXPECT_EQ(replayed(folder / "cut.mcap").ticks, cut.ticks);
}

TEST(Replay, WhatIsNoSessionOfOursIsRefused) {
  const TemporaryFolder folder;
  McapWriter(folder / "foreign.mcap", "library").close();
  McapReader session(folder / "foreign.mcap");
  EXPECT_THROW(settingsOf(session), Error);
}

}  // namespace
}  // namespace helical
