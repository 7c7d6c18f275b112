#include "engine/pipeline/clock_watch.h"

#include <gtest/gtest.h>

#include "engine/base/random.h"

namespace helical {
namespace {

constexpr double kPeriod = 1.0 / 60.0, kReadout = 0.015;

/// Frames with a jitter of a millisecond, whose stamps and arrivals a test shifts.
struct WatchedFrames {
  ClockWatch watch;
  Random random{5};
  std::uint64_t sequence = 0;
  double stamps_off = 0.0, late = 0.0;

  void next(int missing = 0) {
    sequence += 1 + static_cast<std::uint64_t>(missing);
    const double exposed = kPeriod * static_cast<double>(sequence);
    Observation observation;
    observation.sequence = sequence;
    observation.exposure = fromSeconds(exposed + stamps_off);
    observation.arrival = fromSeconds(exposed + kReadout + late + random.uniform(0.0, 0.001));
    watch.add(observation);
  }
  void run(int frames) {
    for (int i = 0; i < frames; ++i) next();
  }
  /// Whether every one of so many frames was off, and known to have a wrong stamp.
  bool jumpedFor(int frames) {
    for (int i = 0; i < frames; ++i) {
      next();
      if (!watch.hasJumped()) return false;
    }
    return true;
  }
};

TEST(ClockWatch, BelievesFramesThatComeAsTheyDid) {
  WatchedFrames frames;
  for (int i = 0; i < 3000; ++i) {
    frames.next(i % 7 == 0 ? 3 : 0);
    frames.stamps_off -= 1e-6;  // clocks drift
    ASSERT_FALSE(frames.watch.isOff());
  }
}

TEST(ClockWatch, DoesNotBelieveTheFirstFrameAfterAJumpAndBelievesTheFirstThatIsRightAgain) {
  for (const double jump : {-0.08, -0.02, 0.02, 0.08}) {
    WatchedFrames frames;
    frames.run(60);
    frames.stamps_off = jump;
    EXPECT_TRUE(frames.jumpedFor(1200)) << jump << ": it gets used to no wrong clock";
    frames.stamps_off = 0.0;
    frames.next();
    EXPECT_FALSE(frames.watch.isOff()) << jump;
    EXPECT_FALSE(frames.watch.hasJumped()) << jump;
  }
}

TEST(ClockWatch, FramesThatComeLateHaveRightStamps) {
  for (const double late : {0.02, 0.12}) {
    WatchedFrames frames;
    frames.run(60);
    frames.late = late;
    for (int i = 0; i < 200; ++i) {
      frames.next();
      ASSERT_TRUE(frames.watch.isOff());
      ASSERT_FALSE(frames.watch.hasJumped());
    }
    frames.late = 0.0;
    frames.next();
    EXPECT_FALSE(frames.watch.isOff());
  }
}

TEST(ClockWatch, GetsUsedToFramesThatStayLate) {
  WatchedFrames frames;
  frames.run(60);
  frames.late = 0.03;
  frames.run(400);
  EXPECT_FALSE(frames.watch.isOff());
  frames.late = 0.0;
  frames.next();
  EXPECT_TRUE(frames.watch.isOff());
}

TEST(ClockWatch, ALateCameraMayJumpOnTopOfIt) {
  WatchedFrames frames;
  frames.run(60);
  frames.late = 0.03;
  frames.run(30);
  frames.stamps_off = -0.05;
  EXPECT_TRUE(frames.jumpedFor(60));
}

TEST(ClockWatch, AStampFromTheFutureAfterALongSilenceIsWrong) {
  WatchedFrames frames;
  frames.run(60);
  frames.stamps_off = 0.03;
  frames.next(120);
  EXPECT_TRUE(frames.watch.hasJumped());
}

}  // namespace
}  // namespace helical
