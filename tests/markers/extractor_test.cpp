#include "engine/markers/extractor.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "engine/base/random.h"
#include "engine/markers/reference_extractor.h"
#include "tests/markers/scenes.h"

namespace helical {
namespace {

using test::Picture;

enum class Scene { kNoise, kBlocks, kBalls, kClutter };

Picture makeScene(Scene scene, int width, int height, PixelFormat format, Random& random) {
  Picture picture(width, height, format, static_cast<int>(random.uniform(0, 5)));
  if (scene == Scene::kNoise) {
    picture.randomise(random);
    return picture;
  }
  picture.fill(105, 115, 125);
  if (scene == Scene::kBlocks) {
    picture.drawRandomBlocks(random, 8, 0.6);
    return picture;
  }
  const int discs = scene == Scene::kBalls ? 4 : 40;
  for (int i = 0; i < discs; ++i)
    picture.drawDisc(random.uniform(0, width), random.uniform(0, height), random.uniform(2, 8), 45, 190, 50);
  picture.addNoise(random, 4.0);
  return picture;
}

void expectSame(const Observation& a, const Observation& b) {
  ASSERT_EQ(a.count, b.count);
  EXPECT_EQ(a.truncated, b.truncated);
  for (std::size_t i = 0; i < static_cast<std::size_t>(a.count); ++i) {
    EXPECT_EQ(a.centroids[i].area_px, b.centroids[i].area_px);
    EXPECT_EQ(a.centroids[i].pixel, b.centroids[i].pixel);
  }
}

MarkerOptions binaryOptions() {
  MarkerOptions options;
  options.estimator = CentroidEstimator::kBinary;
  options.background_rows = 0;  // the reference knows no such thing
  return options;
}

std::vector<MarkerOptions> optionsToTry() {
  const MarkerOptions usual = binaryOptions();
  MarkerOptions bare = usual;
  bare.opening_px = bare.closing_px = bare.minimum_area_px = 1;
  MarkerOptions wide = usual;
  wide.opening_px = 5;
  wide.closing_px = 7;
  MarkerOptions red = usual;
  red.hue_low = 170;
  red.hue_high = 10;
  MarkerOptions any_hue = usual;
  any_hue.hue_low = 0;
  any_hue.hue_high = 179;
  any_hue.saturation_low = 30;
  MarkerOptions dark = usual;
  dark.hue_low = 0;
  dark.hue_high = 179;
  dark.saturation_low = 0;
  dark.value_low = 0;
  dark.value_high = 90;
  return {usual, bare, wide, red, any_hue, dark};
}

class EqualsReference : public testing::TestWithParam<Scene> {};

TEST_P(EqualsReference, InEveryCentroid) {
  constexpr std::array<std::array<int, 2>, 6> kSizes{
      {{160, 120}, {64, 64}, {193, 71}, {127, 40}, {37, 53}, {320, 90}}};
  Random random(42);
  int regions = 0;
  for (const MarkerOptions& options : optionsToTry()) {
    Extractor fast(options);
    ReferenceExtractor reference(options);
    for (const auto& [width, height] : kSizes)
      for (const PixelFormat format : {PixelFormat::kBgr8, PixelFormat::kMono8})
        for (const bool with_background : {false, true}) {
          SCOPED_TRACE(testing::Message() << width << "x" << height << " background " << with_background
                                          << " hue " << options.hue_low << " opening " << options.opening_px);
          if (with_background) {
            const Picture empty = makeScene(GetParam(), width, height, format, random);
            fast.setBackground(empty.view());
            reference.setBackground(empty.view());
          } else {
            fast.disableBackground();
            reference.disableBackground();
          }
          for (int frame = 0; frame < 3; ++frame) {
            const Picture picture = makeScene(GetParam(), width, height, format, random);
            Observation found, expected;
            fast.extract(picture.view(), found);
            reference.extract(picture.view(), expected);
            expectSame(found, expected);
            regions += found.count;
          }
        }
  }
  EXPECT_GT(regions, 500);
}

INSTANTIATE_TEST_SUITE_P(Extractor, EqualsReference,
                         testing::Values(Scene::kNoise, Scene::kBlocks, Scene::kBalls, Scene::kClutter));

TEST(Extractor, FindsADiscWhereItIs) {
  Picture picture(640, 480);
  picture.fill(120, 120, 120);
  picture.drawDisc(300.4, 200.7, 6.0, 45, 190, 50);
  Extractor extractor(binaryOptions());
  extractor.disableBackground();
  Observation found;
  extractor.extract(picture.view(), found);
  ASSERT_EQ(found.count, 1);
  const Centroid& disc = found.centroids[0];
  EXPECT_NEAR(disc.pixel.x(), 300.4, 0.25);
  EXPECT_NEAR(disc.pixel.y(), 200.7, 0.25);
  EXPECT_NEAR(disc.radius_px, 6.0, 0.6);
  EXPECT_DOUBLE_EQ(disc.covariance(0, 0),
                   MarkerOptions{}.centroid_sigma_px * MarkerOptions{}.centroid_sigma_px);
  EXPECT_DOUBLE_EQ(disc.covariance(0, 1), 0.0);
}

TEST(Extractor, FitsADiscWhereItIs) {
  Random random(3);
  for (const PixelFormat format : {PixelFormat::kBgr8, PixelFormat::kRgb8, PixelFormat::kBayerRg8}) {
    Picture picture(640, 480);
    picture.fill(120, 120, 120);
    picture.drawDisc(300.4, 200.7, 7.0, 45, 190, 50);
    picture.addNoise(random, 2.0);
    Extractor extractor(MarkerOptions{});
    extractor.disableBackground();
    Observation found;
    const Picture seen = picture.as(format);
    extractor.extract(seen.view(), found);
    ASSERT_EQ(found.count, 1);
    const Centroid& disc = found.centroids[0];
    const double tolerance = format == PixelFormat::kBayerRg8 ? 0.1 : 0.03;
    EXPECT_NEAR(disc.pixel.x(), 300.4, tolerance);
    EXPECT_NEAR(disc.pixel.y(), 200.7, tolerance);
    EXPECT_NEAR(disc.radius_px, 7.0, 2.0 * tolerance);
    EXPECT_NEAR(disc.area_px, 154.0, 5.0);
    EXPECT_LT(disc.covariance.trace(), 2.0 * tolerance * tolerance);
  }
}

TEST(Extractor, FindsSmallBallsWhereverTheyLieOnTheMosaic) {
  constexpr double kRadius = 2.6;
  Random random(8);
  for (const PixelFormat format : {PixelFormat::kBgr8, PixelFormat::kBayerRg8, PixelFormat::kBayerGb8}) {
    Extractor extractor(MarkerOptions{});
    extractor.disableBackground();
    for (int i = 0; i < 100; ++i) {
      Picture picture(160, 120);
      picture.fill(120, 120, 120);
      picture.drawDisc(80.0 + 2.0 * random.uniform(), 60.0 + 2.0 * random.uniform(), kRadius, 45, 190, 50);
      picture.addNoise(random, 4.0);
      const Picture seen = picture.as(format);
      Observation found;
      extractor.extract(seen.view(), found);
      EXPECT_EQ(found.count, 1) << "format " << static_cast<int>(format) << ", picture " << i;
    }
  }
}

TEST(Extractor, FindsEachColourByItself) {
  constexpr std::array kPlaces{50.0, 120.0, 200.0};
  Picture picture(300, 100);
  picture.fill(120, 120, 120);
  picture.drawDisc(50, 50, 8, 45, 190, 50);
  picture.drawDisc(120, 50, 7, 40, 40, 200);
  picture.drawDisc(200, 50, 6, 200, 60, 40);
  MarkerOptions options;
  ColourRange red, blue;
  red.hue_low = 170, red.hue_high = 10;
  blue.hue_low = 105, blue.hue_high = 130;
  options.other_colours = {red, blue};
  for (const PixelFormat format : {PixelFormat::kBgr8, PixelFormat::kRgb8, PixelFormat::kBayerGb8}) {
    Extractor extractor(options);
    extractor.disableBackground();
    Observation found;
    const Picture seen = picture.as(format);
    extractor.extract(seen.view(), found);
    ASSERT_EQ(found.count, 3);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(found.centroids[i].colour, static_cast<int>(i));
      EXPECT_NEAR(found.centroids[i].pixel.x(), kPlaces[i], 0.3);
    }
  }
}

TEST(Extractor, FindsNothingUntilItsBackgroundIsTaken) {
  Picture empty(200, 100), ball(200, 100);
  empty.fill(120, 120, 120);
  ball.fill(120, 120, 120);
  ball.drawDisc(50, 50, 6, 45, 190, 50);
  MarkerOptions options;
  options.background_frames = 3;
  Extractor extractor(options);
  Observation found;
  for (int i = 0; i < 2; ++i) {
    extractor.extract(ball.view(), found);
    EXPECT_FALSE(extractor.hasBackground());
    EXPECT_EQ(found.count, 0);
  }
  extractor.takeBackground();
  for (int i = 0; i < 3; ++i) extractor.extract(empty.view(), found);
  EXPECT_TRUE(extractor.hasBackground());
  extractor.extract(ball.view(), found);
  EXPECT_EQ(found.count, 1);
}

TEST(Extractor, IgnoresMarkerColourThatBelongsToTheBackground) {
  Picture empty(200, 100);
  empty.fill(120, 120, 120);
  empty.drawDisc(150, 30, 9, 45, 190, 50);
  Picture picture = empty;
  picture.drawDisc(50, 50, 6, 45, 190, 50);
  Extractor extractor(MarkerOptions{});
  extractor.setBackground(empty.view());
  Observation found;
  extractor.extract(picture.view(), found);
  ASSERT_EQ(found.count, 1);
  EXPECT_NEAR(found.centroids[0].pixel.x(), 50, 0.5);
}

TEST(Extractor, TakesItsBackgroundAnewWhenTheImageSizeChanges) {
  Picture small(100, 80), large(200, 100);
  small.fill(120, 120, 120);
  large.fill(120, 120, 120);
  Extractor extractor(MarkerOptions{});
  extractor.setBackground(small.view());
  Observation found;
  extractor.extract(large.view(), found);
  EXPECT_FALSE(extractor.hasBackground());
}

TEST(Extractor, KeepsTheLargestRegionsOfClutter) {
  Picture picture(640, 480);
  picture.fill(120, 120, 120);
  for (int i = 0; i < 40; ++i)
    picture.drawDisc(40 + 70 * (i % 8), 40 + 80 * (i / 8), 4 + 0.2 * i, 45, 190, 50);
  Extractor extractor(binaryOptions());
  extractor.disableBackground();
  Observation found;
  extractor.extract(picture.view(), found);
  EXPECT_TRUE(found.truncated);
  ASSERT_EQ(found.count, kMaxCentroids);
  for (std::size_t i = 1; i < kMaxCentroids; ++i)
    EXPECT_GE(found.centroids[i - 1].area_px, found.centroids[i].area_px);
}

}  // namespace
}  // namespace helical
