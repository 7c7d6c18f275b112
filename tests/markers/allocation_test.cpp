#include <gtest/gtest.h>

#include "engine/base/random.h"
#include "engine/markers/extractor.h"
#include "tests/markers/scenes.h"
#include "tests/support/allocation_counter.h"

namespace helical {
namespace {

TEST(ExtractorAllocation, NoneAfterTheFirstFrameOfASize) {
  Random random(1);
  test::Picture empty(320, 240), clutter(320, 240), noise(320, 240);
  empty.fill(120, 120, 120);
  clutter.fill(120, 120, 120);
  clutter.drawRandomBlocks(random, 8, 0.7);
  noise.randomise(random);
  MarkerOptions options;
  options.opening_px = options.closing_px = options.minimum_area_px = 1;  // every pixel may be a region
  options.background_frames = 2;
  Extractor extractor(options);
  Observation found;
  extractor.extract(empty.view(), found);
  const long before = test::allocations();
  for (int i = 0; i < 3; ++i) {
    extractor.extract(empty.view(), found);
    extractor.extract(clutter.view(), found);
    extractor.extract(noise.view(), found);
  }
  extractor.takeBackground();
  extractor.extract(empty.view(), found);
  EXPECT_EQ(test::allocations(), before);
  EXPECT_TRUE(found.count == 0);
}

}  // namespace
}  // namespace helical
