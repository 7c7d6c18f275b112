#include "ui/time_axis.h"

#include <gtest/gtest.h>

namespace helical {
namespace {

TEST(TimeAxis, FollowsTheNewestTick) {
  TimeAxis axis;
  axis.advance(0.0, 12.0);
  EXPECT_EQ(axis.begin(), 0.0) << "a short flight begins at the left";
  axis.advance(0.0, 100.0);
  EXPECT_EQ(axis.end(), 100.0);
  EXPECT_EQ(axis.begin(), 70.0);
}

TEST(TimeAxis, ScrolledBackItStandsStillUntilItIsLiveAgain) {
  TimeAxis axis;
  axis.advance(0.0, 100.0);
  axis.scroll(-40.0);
  EXPECT_FALSE(axis.live());
  axis.advance(0.0, 200.0);
  EXPECT_EQ(axis.end(), 60.0);
  axis.setLive(true);
  EXPECT_EQ(axis.end(), 200.0);
}

TEST(TimeAxis, ScrollingToTheNewestFollowsAgain) {
  TimeAxis axis;
  axis.advance(0.0, 100.0);
  axis.scroll(-40.0);
  axis.scroll(1000.0);
  EXPECT_TRUE(axis.live());
  EXPECT_EQ(axis.end(), 100.0);
}

TEST(TimeAxis, NothingIsShownFromBeforeTheOldestTick) {
  TimeAxis axis;
  axis.advance(50.0, 150.0);
  axis.scroll(-1000.0);
  EXPECT_EQ(axis.begin(), 50.0);
}

TEST(TimeAxis, ZoomKeepsTheTimeUnderThePointer) {
  TimeAxis axis;
  axis.advance(0.0, 500.0);
  axis.scroll(-200.0);
  const double about = axis.begin() + 10.0;
  axis.zoom(0.5, about);
  EXPECT_NEAR(axis.end() - axis.begin(), 15.0, 1e-9);
  EXPECT_NEAR(about - axis.begin(), 5.0, 1e-9);
  for (int i = 0; i < 100; ++i) axis.zoom(0.5, about);
  EXPECT_NEAR(axis.end() - axis.begin(), TimeAxis::kShortest, 1e-9);
}

TEST(TimeAxis, ZoomWhileLiveKeepsFollowing) {
  TimeAxis axis;
  axis.advance(0.0, 500.0);
  axis.zoom(2.0, 480.0);
  EXPECT_TRUE(axis.live());
  EXPECT_EQ(axis.end(), 500.0);
  EXPECT_NEAR(axis.end() - axis.begin(), 60.0, 1e-9);
}

}  // namespace
}  // namespace helical
