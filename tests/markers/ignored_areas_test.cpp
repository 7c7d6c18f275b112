#include "engine/markers/ignored_areas.h"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "engine/markers/extracting_source.h"
#include "engine/markers/ignoring_source.h"
#include "tests/markers/scenes.h"

namespace helical {
namespace {

using test::Picture;

const IgnoredAreas kLeftHalf{{{-10, -10}, {99.6, -10}, {99.6, 500}, {-10, 500}}};

Picture twoBalls() {
  Picture picture(200, 80);
  picture.fill(120, 120, 120);
  picture.drawDisc(50, 40, 8, 45, 190, 50);
  picture.drawDisc(150, 40, 6, 45, 190, 50);
  return picture;
}

TEST(IgnoredAreas, HoldWhatLiesInsideByTheEvenOddRule) {
  const Polygon star{{50, 0}, {79, 90}, {2, 35}, {98, 35}, {21, 90}};
  EXPECT_TRUE(contains(star, {50, 15}));
  EXPECT_FALSE(contains(star, {50, 50}));  // inside twice
  EXPECT_FALSE(contains(star, {5, 5}));
  EXPECT_TRUE(isIgnored({star, {{0, 0}, {10, 0}, {0, 10}}}, {3, 3}));
  EXPECT_FALSE(isIgnored({}, {3, 3}));
}

TEST(IgnoredAreas, BecomeAMaskOfCells) {
  const Picture picture(200, 80);
  BinaryMask mask;
  fillMask(kLeftHalf, CellGrid(picture.view()), mask);
  EXPECT_TRUE(mask.at(0, 0) && mask.at(99, 79));
  EXPECT_FALSE(mask.at(100, 0) || mask.at(199, 40));
  const Picture raw = picture.as(PixelFormat::kBayerRg8);
  fillMask(kLeftHalf, CellGrid(raw.view()), mask);
  EXPECT_TRUE(mask.at(49, 0));  // its centre is at 98.5
  EXPECT_FALSE(mask.at(50, 39));
}

TEST(IgnoredAreas, HideWhatTheExtractorWouldFind) {
  for (const PixelFormat format : {PixelFormat::kBgr8, PixelFormat::kBayerGr8, PixelFormat::kMono8}) {
    MarkerOptions options;
    options.value_low = 150;
    Extractor extractor(options);
    extractor.disableBackground();
    const Picture seen = twoBalls().as(format);
    Observation found;
    extractor.extract(seen.view(), found);
    EXPECT_EQ(found.count, 2);
    extractor.setIgnoredAreas(kLeftHalf);
    extractor.extract(seen.view(), found);
    ASSERT_EQ(found.count, 1);
    EXPECT_NEAR(found.centroids[0].pixel.x(), 150, 0.5);
    extractor.setIgnoredAreas({});
    extractor.extract(seen.view(), found);
    EXPECT_EQ(found.count, 2);
  }
}

/// The same picture again and again.
class StillCamera final : public CameraSource {
 public:
  explicit StillCamera(Picture picture) : picture_(std::move(picture)) {}
  CameraId camera() const override { return cameraId(0); }
  bool poll(Frame& frame) override {
    frame = {camera(), ++sequence_, 0, 0, picture_.view()};
    return true;
  }
  void wait(TimeNs) override {}

 private:
  Picture picture_;
  std::uint64_t sequence_ = 0;
};

TEST(ExtractorOrders, AreCarriedOutBeforeTheNextFrame) {
  MarkerOptions options;
  options.background_frames = 1;
  const auto orders = std::make_shared<ExtractorOrders>();
  ExtractingSource source(std::make_unique<StillCamera>(twoBalls()), options, {}, orders);
  Observation seen;
  source.poll(seen);
  source.poll(seen);
  EXPECT_EQ(seen.count, 0);  // both are background
  ColourRange blue;
  blue.hue_low = 105, blue.hue_high = 130;
  orders->seek(MarkerColours({blue}));
  orders->ignore(kLeftHalf);
  source.poll(seen);
  EXPECT_EQ(seen.count, 0);
  EXPECT_THROW(MarkerColours(std::vector<ColourRange>{}), std::exception);
  blue.hue_low = 500;
  EXPECT_THROW(MarkerColours({blue}), std::exception);
}

TEST(ExtractorOrders, ChangeTheColours) {
  Picture picture = twoBalls();
  picture.drawDisc(100, 20, 7, 200, 60, 40);
  Extractor extractor(MarkerOptions{});
  extractor.disableBackground();
  Observation found;
  extractor.extract(picture.view(), found);
  EXPECT_EQ(found.count, 2);
  ColourRange blue;
  blue.hue_low = 105, blue.hue_high = 130;
  extractor.setColours(MarkerColours({blue}));
  extractor.extract(picture.view(), found);
  ASSERT_EQ(found.count, 1);
  EXPECT_NEAR(found.centroids[0].pixel.x(), 100, 0.5);
  extractor.setColours(MarkerColours({blue, ColourRange{}}));
  const Picture raw = picture.as(PixelFormat::kRgb8);
  extractor.extract(raw.view(), found);
  EXPECT_EQ(found.count, 3);
}

TEST(ExtractorOrders, TakeTheBackgroundAnew) {
  MarkerOptions options;
  options.background_frames = 1;
  Extractor extractor(options);
  Picture empty(200, 80);
  empty.fill(120, 120, 120);
  Observation found;
  extractor.extract(empty.view(), found);
  extractor.extract(twoBalls().view(), found);
  EXPECT_EQ(found.count, 2);
  ExtractorOrders orders;
  orders.takeBackground();
  orders.carryOut(extractor);
  extractor.extract(twoBalls().view(), found);
  orders.carryOut(extractor);
  extractor.extract(twoBalls().view(), found);
  EXPECT_TRUE(extractor.hasBackground());
  EXPECT_EQ(found.count, 0);
}

/// Two centroids, without images.
class TwoCentroids final : public ObservationSource {
 public:
  CameraId camera() const override { return cameraId(0); }
  bool poll(Observation& observation) override {
    observation.count = 2;
    observation.centroids[0].pixel = {50, 40};
    observation.centroids[1].pixel = {150, 40};
    return true;
  }
  void wait(TimeNs) override {}
};

TEST(IgnoringSource, LeavesOutCentroidsInTheAreas) {
  const auto orders = std::make_shared<ExtractorOrders>();
  IgnoringSource source(std::make_unique<TwoCentroids>(), orders);
  Observation seen;
  ASSERT_TRUE(source.poll(seen));
  EXPECT_EQ(seen.count, 2);
  orders->ignore(kLeftHalf);
  ASSERT_TRUE(source.poll(seen));
  ASSERT_EQ(seen.count, 1);
  EXPECT_EQ(seen.centroids[0].pixel.x(), 150);
}

}  // namespace
}  // namespace helical
