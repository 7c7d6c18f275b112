#include "ui/camera_track_history.h"

#include <gtest/gtest.h>

namespace helical {
namespace {

CameraTrack trackAt(TimeNs exposure) {
  CameraTrack track;
  track.exposure = exposure;
  return track;
}

constexpr TimeNs kFrame = 16'666'667;

TEST(CameraTrackHistory, FindsTheTrackOfThatVeryFrame) {
  CameraTrackHistory history;
  for (int i = 1; i <= 100; ++i) history.add(trackAt(i * kFrame));
  ASSERT_NE(history.at(95 * kFrame), nullptr);
  EXPECT_EQ(history.at(95 * kFrame)->exposure, 95 * kFrame);
  EXPECT_EQ(history.newest()->exposure, 100 * kFrame);
}

TEST(CameraTrackHistory, TakesTheNearestButNeverOneFromLongAgo) {
  CameraTrackHistory history;
  EXPECT_EQ(history.at(kFrame), nullptr);
  EXPECT_EQ(history.newest(), nullptr);
  history.add(trackAt(10 * kFrame));
  ASSERT_NE(history.at(11 * kFrame), nullptr);
  EXPECT_EQ(history.at(30 * kFrame), nullptr);
}

TEST(CameraTrackHistory, OneFrameSeenInManyTicksIsHeldOnce) {
  CameraTrackHistory history;
  history.add(trackAt(kFrame));
  for (int i = 0; i < 100; ++i) history.add(trackAt(2 * kFrame));
  EXPECT_EQ(history.at(kFrame)->exposure, kFrame);
}

}  // namespace
}  // namespace helical
