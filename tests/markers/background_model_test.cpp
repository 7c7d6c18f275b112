#include "engine/markers/background_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/random.h"
#include "engine/markers/background_kernels.h"
#include "engine/markers/cell_kernels.h"
#include "engine/markers/extractor.h"
#include "tests/markers/scenes.h"

namespace helical {
namespace {

using test::Picture;

Picture grey(int level) {
  Picture picture(200, 60);
  picture.fill(level, level, level);
  return picture;
}

int levelAt(const BackgroundModel& background, int x, int y) {
  const ImageView view = background.view();
  return view.row(y)[3 * x];
}

TEST(BackgroundModel, FollowsTheLightRowByRow) {
  BackgroundModel background(1);
  background.update(grey(100).view());
  for (int frame = 0; frame < 30; ++frame) background.adapt(grey(103).view(), 2, 20, {});
  EXPECT_EQ(levelAt(background, 10, 0), 101);  // each of 60 rows once
  EXPECT_EQ(levelAt(background, 199, 59), 101);
  for (int frame = 0; frame < 300; ++frame) background.adapt(grey(103).view(), 2, 20, {});
  EXPECT_EQ(levelAt(background, 10, 30), 103);
  for (int frame = 0; frame < 300; ++frame) background.adapt(grey(90).view(), 2, 20, {});
  EXPECT_EQ(levelAt(background, 10, 30), 93);
}

TEST(BackgroundModel, KeepsOutWhatIsFoundAndWhatDiffersTooMuch) {
  BackgroundModel background(1);
  background.update(grey(100).view());
  Picture seen = grey(105);
  seen.drawDisc(30, 30, 8, 105, 190, 105);
  for (int frame = 0; frame < 600; ++frame) background.adapt(seen.view(), 2, 20, {100, 20, 140, 40});
  EXPECT_EQ(levelAt(background, 99, 30), 105);
  EXPECT_EQ(levelAt(background, 100, 30), 100);
  EXPECT_EQ(levelAt(background, 140, 20), 100);
  EXPECT_EQ(levelAt(background, 141, 40), 105);
  EXPECT_EQ(levelAt(background, 120, 41), 105);
  const ImageView view = background.view();
  EXPECT_EQ(view.row(30)[3 * 30 + 1], 100);  // the ball's green
}

/// Cells that lie outside of what is known of their tile, and levels by which the tiles say more than there
/// is.
std::pair<int, int> outsideAndSlack(const BackgroundCells& cells) {
  int outside = 0, slack = 0;
  for (int y = 0; y < cells.height; y += BackgroundRanges::kTileRows)
    for (int x = 0; x < cells.width; x += 64) {
      CellRange exact;
      for (int dy = 0; dy < std::min(BackgroundRanges::kTileRows, cells.height - y); ++dy)
        for (int dx = 0; dx < std::min(64, cells.width - x); ++dx) {
          CellRange cell;
          readCell(cells, x + dx, y + dy, cell.low.data());
          cell.high = cell.low;
          exact.include(cell);
        }
      const CellRange& known = cells.range(y, x / 64);
      for (std::size_t i = 0; i < static_cast<std::size_t>(cells.layout == CellLayout::kBytes ? 1 : 3); ++i) {
        outside += (known.low[i] > exact.low[i] || known.high[i] < exact.high[i]) ? 1 : 0;
        slack += exact.low[i] - known.low[i] + known.high[i] - exact.high[i];
      }
    }
  return {outside, slack};
}

TEST(BackgroundModel, KnowsTheRangesOfItsCells) {
  for (const std::string& instructions : instructionSets())
    for (const PixelFormat format :
         {PixelFormat::kBgr8, PixelFormat::kMono8, PixelFormat::kBayerRg8, PixelFormat::kBayerGb8}) {
      useInstructionSet(instructions);
      SCOPED_TRACE(testing::Message() << instructions << ", format " << static_cast<int>(format));
      Random random(5);
      Picture before(333, 75), after(333, 75);
      before.fill(100, 110, 120);
      before.addNoise(random, 5.0);
      after.fill(112, 104, 120);
      after.addNoise(random, 5.0);
      BackgroundModel background(1);
      background.update(before.as(format).view());
      const auto known = [&] {
        return outsideAndSlack(BackgroundCells(CellGrid(background.view()), &background.ranges()));
      };
      EXPECT_EQ(known(), std::pair(0, 0));
      for (int frame = 0; frame < 75; ++frame) {
        background.adapt(after.as(format).view(), 1, 20, {40, 20, 90, 50});
        ASSERT_EQ(known().first, 0);
      }
      EXPECT_LE(known().second,
                format == PixelFormat::kBayerRg8 || format == PixelFormat::kBayerGb8 ? 200 : 0);
      for (int frame = 0; frame < 100; ++frame) background.adapt(after.as(format).view(), 7, 20, {});
      EXPECT_EQ(known().first, 0);
    }
  useInstructionSet({});
}

TEST(BackgroundModel, MovesTheSameBytesInEveryInstructionSet) {
  Random random(2);
  std::vector<std::uint8_t> seen(1003), start(1003);
  for (auto* bytes : {&seen, &start})
    for (auto& byte : *bytes) byte = static_cast<std::uint8_t>(random.uniform(0, 256));
  std::vector<std::uint8_t> expected = start;
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (std::abs(seen[i] - start[i]) <= 40)
      expected[i] = static_cast<std::uint8_t>(start[i] + (seen[i] > start[i]) - (seen[i] < start[i]));
  for (const std::string& name : instructionSets()) {
    useInstructionSet(name);
    std::vector<std::uint8_t> mean = start;
    moveTowards(seen.data(), seen.size(), 40, mean.data());
    EXPECT_EQ(mean, expected) << name;
  }
  useInstructionSet({});
}

/// A wall of marker colour that slowly gets lighter by 60 levels, three times the threshold.
int largestCount(int rows, PixelFormat format) {
  MarkerOptions options;
  options.background_rows = rows;
  options.background_frames = 1;
  Extractor extractor(options);
  Observation found;
  int most = 0, balls = 0;
  for (int frame = 0; frame < 600; ++frame) {
    Picture picture(128, 60);
    picture.fill(50, 120 + frame / 10, 50);
    if (frame > 0) picture.drawDisc(64, 30, 5, 20, 250, 20);
    const Picture seen = picture.as(format);
    extractor.extract(seen.view(), found);
    most = std::max(most, found.count);
    balls += found.count == 1 && std::abs(found.centroids[0].pixel.x() - 64) < 2;
  }
  EXPECT_TRUE(rows == 0 || balls == 599);
  return most;
}

TEST(Extractor, FollowsTheLightOnAWallOfTheMarkersColour) {
  for (const PixelFormat format : {PixelFormat::kBgr8, PixelFormat::kBayerRg8}) {
    EXPECT_EQ(largestCount(8, format), 1);
  }
}

TEST(Extractor, NeverLearnsABallThatStandsStill) {
  MarkerOptions options;
  options.background_rows = 60;
  options.background_frames = 1;
  options.minimum_area_px = 1000;  // not found, hence not kept out
  Extractor extractor(options);
  Picture empty = grey(120), ball = grey(120);
  ball.drawDisc(100, 30, 6, 45, 190, 50);
  Observation found;
  extractor.extract(empty.view(), found);
  for (int frame = 0; frame < 400; ++frame) extractor.extract(ball.view(), found);
  EXPECT_EQ(found.count, 0);
  Picture two = ball;
  two.drawDisc(40, 30, 24, 45, 190, 50);
  extractor.extract(two.view(), found);
  EXPECT_EQ(found.count, 1);
  EXPECT_EQ(extractor.hasBackground(), true);
}

}  // namespace
}  // namespace helical
