#include "ui/image_heat.h"

#include <gtest/gtest.h>

#include <cmath>

namespace helical {
namespace {

CameraTrack trackOf(TimeNs exposure, const Eigen::Vector2d& pixel, const Eigen::Vector2d& error) {
  CameraTrack track;
  track.exposure = exposure;
  track.markers[0].observed = track.markers[0].selected = track.markers[0].predicted = true;
  track.markers[0].pixel = pixel;
  track.markers[0].reprojected = pixel + error;
  return track;
}

TEST(ImageHeat, CountsWhereMarkersWereSeen) {
  ImageHeat heat({640, 480});
  heat.add(trackOf(1, {-0.4, -0.4}, {0, 0}), 4);
  heat.add(trackOf(2, {639.4, 479.4}, {0, 0}), 4);
  heat.add(trackOf(3, {639.0, 479.0}, {0, 0}), 4);
  EXPECT_EQ(heat.count(0, 0), 1);
  EXPECT_EQ(heat.count(ImageHeat::kColumns - 1, ImageHeat::kRows - 1), 2);
  EXPECT_EQ(heat.largestCount(), 2);
  EXPECT_NEAR(heat.covered(), 2.0 / (16 * 12), 1e-12);
}

TEST(ImageHeat, AFrameCountsOnceAndOutsideNotAtAll) {
  ImageHeat heat({640, 480});
  const CameraTrack track = trackOf(5, {100, 100}, {0, 0});
  heat.add(track, 4);
  heat.add(track, 4);
  heat.add(trackOf(6, {-30, 100}, {0, 0}), 4);
  heat.add(trackOf(7, {100, 900}, {0, 0}), 4);
  EXPECT_EQ(heat.largestCount(), 1);
}

TEST(ImageHeat, OnlySelectedMarkersCount) {
  ImageHeat heat({640, 480});
  CameraTrack track = trackOf(5, {100, 100}, {0, 0});
  track.markers[0].selected = false;
  heat.add(track, 4);
  EXPECT_EQ(heat.largestCount(), 0);
  EXPECT_EQ(heat.largestResidual(), 0.0);
}

TEST(ImageHeat, ResidualIsTheRmsOfTheCell) {
  ImageHeat heat({640, 480});
  heat.add(trackOf(1, {100, 100}, {3, 0}), 4);
  heat.add(trackOf(2, {101, 101}, {0, 4}), 4);
  EXPECT_NEAR(heat.residual(2, 2), std::sqrt((9.0 + 16.0) / 2.0), 1e-12);
  EXPECT_TRUE(std::isnan(heat.residual(0, 0)));
  EXPECT_NEAR(heat.largestResidual(), heat.residual(2, 2), 1e-12);
  heat.clear();
  EXPECT_EQ(heat.largestCount(), 0);
}

}  // namespace
}  // namespace helical
