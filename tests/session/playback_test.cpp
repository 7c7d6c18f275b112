#include "engine/session/flight_playback.h"

#include <gtest/gtest.h>

#include <map>

#include "engine/base/error.h"
#include "engine/pipeline/first_guess.h"
#include "engine/pipeline/lock_step.h"
#include "engine/session/recorder.h"
#include "tests/session/session_fixture.h"

namespace helical {
namespace {

using test::TemporaryFolder;

constexpr int kTicks = 900;  // 15 s: take-off and hover

/// A flight, as it was recorded and as it was seen.
struct Flown {
  std::vector<EngineSnapshot> ticks;
  std::filesystem::path file;
};

Flown fly(const TemporaryFolder& folder, bool images) {
  SessionSettings settings = test::hoverSettings(31);
  settings.rig.calibrator = "particle-filter";
  giveFirstGuesses(settings.rig, 0.26, 0.4, 31, false);
  const int ticks = images ? 200 : kTicks;
  if (images) {
    settings.rig.simulation.images = true;
    settings.images = {{ImageQuality::kLossless, 10.0}, {ImageQuality::kJpeg, 0.0}, {}};
  }
  Flown flown;
  flown.file = folder / "a.mcap";
  Recorder recorder(flown.file, settings, Recorder::WhenFull::kWait);
  LockStep flight(settings.rig, settings.plan, &recorder);
  OperatorCommands commands;
  for (int i = 0; i < ticks; ++i) {
    commands.arm = commands.take_off = i == 60;
    flown.ticks.push_back(flight.tick(commands));
  }
  return flown;
}

/// All that a panel shows of a tick, but for what is written ten times a second only.
void expectSame(const EngineSnapshot& a, const EngineSnapshot& b) {
  ASSERT_EQ(a.time, b.time);
  EXPECT_EQ(a.tick, b.tick);
  EXPECT_EQ(a.phase, b.phase);
  EXPECT_EQ(a.safety, b.safety);
  EXPECT_EQ(a.failsafes, b.failsafes);
  EXPECT_EQ(a.pose_known, b.pose_known);
  EXPECT_EQ(a.hovering, b.hovering);
  EXPECT_EQ(a.sticks, b.sticks);
  EXPECT_EQ(a.set_point.position_in_world, b.set_point.position_in_world);
  EXPECT_NEAR(a.set_point.yaw, b.set_point.yaw, 1e-12);
  EXPECT_EQ(a.has_truth, b.has_truth);
  EXPECT_EQ(a.truth.world_from_body.translation, b.truth.world_from_body.translation);
  EXPECT_EQ(a.plans, b.plans);
  EXPECT_EQ(a.colours, b.colours);
  EXPECT_EQ(a.cameras_disagree, b.cameras_disagree);
  EXPECT_STREQ(a.cold_start == nullptr ? "" : a.cold_start, b.cold_start == nullptr ? "" : b.cold_start);
  EXPECT_STREQ(a.obstacle == nullptr ? "" : a.obstacle, b.obstacle == nullptr ? "" : b.obstacle);
  if (a.pose_known) {
    EXPECT_EQ(a.tracked.state.world_from_body.translation, b.tracked.state.world_from_body.translation);
    EXPECT_EQ(a.tracked.state.velocity_in_world, b.tracked.state.velocity_in_world);
    EXPECT_TRUE(
        a.tracked.state.angular_velocity_in_body.isApprox(b.tracked.state.angular_velocity_in_body, 1e-9));
    EXPECT_TRUE(a.tracked.pose_covariance.isApprox(b.tracked.pose_covariance, 1e-9));
  }
  for (std::size_t c = 0; c < 3; ++c) {
    const CameraSnapshot &one = a.cameras[c], &other = b.cameras[c];
    EXPECT_EQ(one.estimate.status, other.estimate.status);
    EXPECT_TRUE(one.estimate.covariance.isApprox(other.estimate.covariance, 1e-9));
    EXPECT_TRUE(one.estimate.camera_from_world.translation.isApprox(
        other.estimate.camera_from_world.translation, 1e-12));
    EXPECT_EQ(one.track.exposure, other.track.exposure);
    EXPECT_EQ(one.track.selected_count, other.track.selected_count);
    EXPECT_EQ(one.track.residual_px, other.track.residual_px);
    for (std::size_t m = 0; m < 4; ++m) {
      EXPECT_EQ(one.track.markers[m].pixel, other.track.markers[m].pixel);
      EXPECT_EQ(one.track.markers[m].reprojected, other.track.markers[m].reprojected);
    }
    EXPECT_STREQ(one.calibration_method, other.calibration_method);
  }
}

TEST(Playback, ShowsEveryTickAsItWas) {
  const TemporaryFolder folder;
  const Flown flown = fly(folder, false);
  auto clock = std::make_shared<ManualClock>();
  FlightPlayback playback(flown.file, clock);
  EXPECT_TRUE(playback.complete());
  EXPECT_EQ(playback.rig().cameras.size(), 3u);
  playback.play();
  std::vector<EngineSnapshot> seen;
  EngineSnapshot tick;
  std::vector<std::string> events;
  EngineEvent event;
  for (int i = 0; playback.playing(); ++i) {
    ASSERT_LT(i, 2000);
    clock->set(clock->now() + 16 * kNanosecondsPerMillisecond);
    playback.poll();
    while (playback.nextTick(tick)) seen.push_back(tick);
    while (playback.nextEvent(event)) events.emplace_back(event.text.data());
  }
  ASSERT_EQ(seen.size(), flown.ticks.size());
  for (std::size_t i = 0; i < seen.size(); ++i) {
    expectSame(flown.ticks[i], seen[i]);
    if (HasFailure()) FAIL() << "tick " << i;
  }
  const TriedLabellings &tried = flown.ticks.back().cameras[2].labellings,
                        &shown = seen.back().cameras[2].labellings;
  ASSERT_GE(tried.count, 2);
  ASSERT_EQ(shown.count, tried.count);
  for (std::size_t i = 0; i < static_cast<std::size_t>(tried.count); ++i) {
    EXPECT_EQ(shown.all[i].value, tried.all[i].value);
    EXPECT_EQ(shown.all[i].marker, tried.all[i].marker);
  }
  EXPECT_FALSE(shown.by_misfit);
  EXPECT_EQ(playback.lostTicks(), 0u);
  EXPECT_EQ(events.size(), playback.events().size());
  EXPECT_NE(std::find(events.begin(), events.end(), "Lift-off"), events.end());
  EXPECT_TRUE(playback.pollCalibration(cameraId(2)));
  EXPECT_GT(playback.calibration(cameraId(2)).count, 100);
  EXPECT_FALSE(playback.pollCalibration(cameraId(0)));
}

TEST(Playback, SeeksStepsAndGoesRound) {
  const TemporaryFolder folder;
  const Flown flown = fly(folder, false);
  auto clock = std::make_shared<ManualClock>();
  FlightPlayback playback(flown.file, clock);
  for (const int target : {700, 100, 850, 400, 401, 20}) {
    playback.seek(flown.ticks[static_cast<std::size_t>(target)].time);
    EXPECT_TRUE(playback.poll());
    expectSame(flown.ticks[static_cast<std::size_t>(target)], playback.snapshot());
  }
  EngineSnapshot tick, last;
  playback.seek(flown.ticks[800].time);
  for (std::uint64_t expected = 1; playback.nextTick(tick); ++expected) EXPECT_EQ(tick.tick, expected);
  EXPECT_EQ(tick.tick, flown.ticks[800].tick);  // with all of the time before it, as plots want it
  playback.step(1);
  EXPECT_EQ(playback.snapshot().tick, flown.ticks[801].tick);
  playback.step(-1);
  EXPECT_EQ(playback.snapshot().tick, flown.ticks[800].tick);
  playback.step(-1);
  EXPECT_EQ(playback.snapshot().tick, flown.ticks[799].tick);

  playback.setLoop(FlightPlayback::Loop{5 * kNanosecondsPerSecond, 6 * kNanosecondsPerSecond});
  playback.setSpeed(50.0);
  EXPECT_EQ(playback.speed(), FlightPlayback::kFastest);
  playback.play();
  clock->set(clock->now() + kNanosecondsPerSecond / 10);
  playback.poll();
  EXPECT_EQ(playback.position(), 5 * kNanosecondsPerSecond);
  clock->set(clock->now() + kNanosecondsPerSecond / 20);
  playback.poll();
  EXPECT_EQ(playback.position(), 5 * kNanosecondsPerSecond + kNanosecondsPerSecond / 2);
}

TEST(Playback, ShowsRecordedImagesAndDiscsWhereThereAreNone) {
  const TemporaryFolder folder;
  const Flown flown = fly(folder, true);
  McapReader reader(flown.file);
  std::map<std::string, int> images;
  reader.read([&](const McapMessage& message) {
    const std::string& topic = reader.channels().at(message.channel).topic;
    if (topic.find("image_raw") != std::string::npos) ++images[topic];
  });
  EXPECT_EQ(images.size(), 2u);
  EXPECT_NEAR(images["/cameras/1/image_raw"], 33, 2);
  EXPECT_NEAR(images["/cameras/2/image_raw/compressed"], 198, 5);
  FlightPlayback playback(flown.file, std::make_shared<ManualClock>());
  playback.seek(3 * kNanosecondsPerSecond);
  const auto green = [](const CameraPicture& picture) {
    int count = 0;
    for (std::size_t i = 0; i < picture.bgr.size(); i += 3)
      count += picture.bgr[i + 1] > 60 + std::max(picture.bgr[i], picture.bgr[i + 2]);
    return count;
  };
  for (int camera = 0; camera < 3; ++camera) {
    ASSERT_TRUE(playback.pollPicture(cameraId(camera))) << camera;
    const CameraPicture& picture = playback.picture(cameraId(camera));
    EXPECT_EQ(picture.width, 640);
    EXPECT_EQ(picture.bgr.size(), 640u * 480u * 3u);
    EXPECT_GT(green(picture), 50) << camera;  // the balls
    EXPECT_EQ(picture.observation.count, 4) << camera;
    EXPECT_FALSE(playback.pollPicture(cameraId(camera))) << camera;
  }
}

TEST(Playback, ImagesThatWereRecordedForAWhileAreShownThenAndOnlyThen) {
  const TemporaryFolder folder;
  const auto file = folder / "a.mcap";
  SessionSettings settings = test::hoverSettings(31);
  settings.rig.simulation.images = true;
  settings.images = {{ImageQuality::kJpeg, 0.0, false}, {}, {}};
  {
    Recorder recorder(file, settings, Recorder::WhenFull::kWait);
    LockStep flight(settings.rig, settings.plan, &recorder);
    EXPECT_FALSE(recorder.recordsImages());
    for (int i = 0; i < 420; ++i) {
      if (i == 60 || i == 120) recorder.recordImages(i == 60);
      flight.tick({});
    }
    EXPECT_FALSE(recorder.recordsImages());
  }
  FlightPlayback playback(file, std::make_shared<ManualClock>());
  // Discs stand on paper of one colour, which no rendered room has in all four corners.
  const auto image = [&](double seconds) {
    playback.seek(fromSeconds(seconds));
    playback.pollPicture(cameraId(0));
    const std::vector<std::uint8_t>& bgr = playback.picture(cameraId(0)).bgr;
    const std::size_t row = 3 * 640, last = bgr.size() - 3;
    return !(std::equal(&bgr[0], &bgr[3], &bgr[row - 3]) && std::equal(&bgr[0], &bgr[3], &bgr[last]));
  };
  EXPECT_FALSE(image(0.9));
  EXPECT_TRUE(image(1.5));
  EXPECT_TRUE(image(2.5)) << "the last one, for a moment";
  EXPECT_FALSE(image(6.5));
  EXPECT_TRUE(image(1.7));
  EXPECT_FALSE(image(0.5)) << "back before the first one";
}

TEST(Playback, PicturesAndTracksAreTheCamerasWhateverCableTheyCameBy) {
  const TemporaryFolder folder;
  const auto file = folder / "a.mcap";
  constexpr int kTicksOfBoth = 240, kExchanged = 120;
  {
    Recorder recorder(file, test::hoverSettings(31), Recorder::WhenFull::kWait);
    EngineSnapshot state;
    state.camera_count = 3;
    for (int i = 0; i < kTicksOfBoth; ++i) {
      state.time = i * kNanosecondsPerSecond / 60;
      state.tick = static_cast<std::uint64_t>(i);
      if (i == kExchanged) std::swap(state.streams[0], state.streams[1]);
      for (int stream = 0; stream < 3; ++stream) {
        Observation observation;
        observation.camera = cameraId(stream);
        observation.exposure = observation.arrival = state.time;
        observation.count = 1 + stream;
        CameraTrack track;
        track.exposure = state.time;
        track.selected_count = 1 + stream;
        recorder.onObservation(observation, state.time, track);
      }
      recorder.onTick({}, state);
    }
  }
  FlightPlayback playback(file, std::make_shared<ManualClock>());
  const auto seenBy = [&](int camera, double seconds) {
    playback.seek(fromSeconds(seconds));
    playback.pollPicture(cameraId(camera));
    const int seen = playback.picture(cameraId(camera)).observation.count;
    EXPECT_EQ(playback.snapshot().cameras[static_cast<std::size_t>(camera)].track.selected_count, seen);
    return seen;
  };
  for (const auto& [camera, before, after] : {std::array{0, 1, 2}, {1, 2, 1}, {2, 3, 3}}) {
    EXPECT_EQ(seenBy(camera, 1.5), before) << camera;
    EXPECT_EQ(seenBy(camera, 3.0), after) << camera;
    EXPECT_EQ(seenBy(camera, 1.0), before) << camera;
  }
}

TEST(Playback, WhatIsNoSessionIsRefused) {
  const TemporaryFolder folder;
  test::writeBytes(folder / "foreign.mcap", "no session");
  EXPECT_THROW(FlightPlayback(folder / "foreign.mcap"), Error);
  McapWriter(folder / "empty.mcap", "library").close();
  EXPECT_THROW(FlightPlayback(folder / "empty.mcap"), Error);
}

}  // namespace
}  // namespace helical
