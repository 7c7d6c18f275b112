#include "engine/markers/search_windows.h"

#include <gtest/gtest.h>

#include <vector>

#include "engine/markers/extractor.h"
#include "tests/markers/scenes.h"

namespace helical {
namespace {

using test::Picture;

PredictedBall ballAt(double x, double y) {
  PredictedBall ball;
  ball.pixel = {x, y};
  ball.radius_px = 6.0;
  ball.reach_px = 5.0;
  ball.whole = true;
  return ball;
}

BallPredictions predictionsOf(const std::vector<PredictedBall>& balls) {
  BallPredictions predictions;
  predictions.time = 1'000'000'000;
  for (const PredictedBall& ball : balls)
    predictions.balls[static_cast<std::size_t>(predictions.count++)] = ball;
  return predictions;
}

Picture field(const std::vector<Eigen::Vector2d>& balls) {
  Picture picture(640, 480);
  picture.fill(120, 120, 120);
  for (const Eigen::Vector2d& ball : balls) picture.drawDisc(ball.x(), ball.y(), 6, 45, 190, 50);
  return picture;
}

class WindowedExtractor : public testing::Test {
 protected:
  WindowedExtractor() : extractor_(MarkerOptions{}), whole_(MarkerOptions{}) {
    extractor_.disableBackground();
    whole_.disableBackground();
  }

  Observation extract(const Picture& picture) {
    Observation found;
    found.exposure = 1'005'000'000;
    extractor_.extract(picture.view(), found);
    return found;
  }
  void expectSameAsWhole(const Picture& picture) {
    const Observation windowed = extract(picture);
    Observation all;
    whole_.extract(picture.view(), all);
    ASSERT_EQ(windowed.count, all.count);
    for (std::size_t i = 0; i < static_cast<std::size_t>(all.count); ++i) {
      EXPECT_EQ(windowed.centroids[i].pixel, all.centroids[i].pixel);
      EXPECT_EQ(windowed.centroids[i].area_px, all.centroids[i].area_px);
    }
  }

  Extractor extractor_;
  Extractor whole_;
};

TEST_F(WindowedExtractor, FindsTheSameWithoutReadingEverything) {
  extractor_.expect(predictionsOf({ballAt(100, 100), ballAt(130, 104), ballAt(3, 470), ballAt(500, 300)}));
  expectSameAsWhole(field({{102, 99}, {129, 105}, {5, 469}, {503, 302}}));
  EXPECT_FALSE(extractor_.readWhole());
}

TEST_F(WindowedExtractor, SeesNothingElsewhereUntilAFrameIsReadAsAWhole) {
  extractor_.expect(predictionsOf({ballAt(100, 100)}));
  const Picture picture = field({{100, 100}, {400, 300}});
  int seen_both = 0, whole = 0;
  for (int frame = 0; frame < 60; ++frame) {
    const Observation found = extract(picture);
    EXPECT_EQ(found.count, extractor_.readWhole() ? 2 : 1);
    seen_both += found.count == 2;
    whole += extractor_.readWhole();
  }
  EXPECT_EQ(whole, 60 / MarkerOptions{}.whole_every);
  EXPECT_EQ(seen_both, whole);
}

TEST_F(WindowedExtractor, ReadsEverythingAtOnceWhenABallIsMissed) {
  extractor_.expect(predictionsOf({ballAt(100, 100), ballAt(300, 200)}));
  expectSameAsWhole(field({{100, 100}, {420, 200}}));
  EXPECT_TRUE(extractor_.readWhole());
  expectSameAsWhole(field({{101, 100}}));  // one region is not two balls
  EXPECT_TRUE(extractor_.readWhole());
}

TEST_F(WindowedExtractor, ReadsEverythingWhenARegionGoesOnBeyondItsWindow) {
  Picture picture = field({{100, 100}});
  for (int x = 100; x < 600; ++x)
    for (int y = 98; y < 103; ++y) {
      std::uint8_t* p = picture.pixel(x, y);
      p[0] = 45, p[1] = 190, p[2] = 50;
    }
  PredictedBall anywhere = ballAt(100, 100);
  anywhere.reach_px = 60;
  extractor_.expect(predictionsOf({anywhere}));
  expectSameAsWhole(picture);
  EXPECT_TRUE(extractor_.readWhole());
}

TEST_F(WindowedExtractor, DoesNotTrustPredictionsOfAnotherTime) {
  BallPredictions old = predictionsOf({ballAt(100, 100)});
  old.time = 900'000'000;
  extractor_.expect(old);
  expectSameAsWhole(field({{100, 100}, {300, 300}}));
  EXPECT_TRUE(extractor_.readWhole());
  extractor_.expect({});
  expectSameAsWhole(field({{100, 100}, {300, 300}}));
  EXPECT_TRUE(extractor_.readWhole());
}

TEST_F(WindowedExtractor, FollowsTheSpeedOfABall) {
  PredictedBall fast = ballAt(100, 100);
  fast.velocity = {4000.0, 0.0};  // 20 px in the 5 ms to the exposure
  extractor_.expect(predictionsOf({fast}));
  expectSameAsWhole(field({{120, 100}}));
  EXPECT_FALSE(extractor_.readWhole());
}

TEST_F(WindowedExtractor, WorksOnBayerImagesAndAtTheImagesEdge) {
  PredictedBall partly = ballAt(638, 200);
  partly.whole = false;
  extractor_.expect(predictionsOf({ballAt(100, 100), partly}));
  const Picture seen = field({{101, 101}, {638, 200}}).as(PixelFormat::kBayerRg8);
  expectSameAsWhole(seen);
  EXPECT_FALSE(extractor_.readWhole());
}

}  // namespace
}  // namespace helical
