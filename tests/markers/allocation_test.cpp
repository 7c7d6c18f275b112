#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "engine/base/random.h"
#include "engine/markers/extractor.h"
#include "tests/markers/scenes.h"

namespace {

long g_allocations = 0;

void* counted(std::size_t size) {
  ++g_allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) {
  return counted(size);
}
void* operator new[](std::size_t size) {
  return counted(size);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

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
  const long before = g_allocations;
  for (int i = 0; i < 3; ++i) {
    extractor.extract(empty.view(), found);
    extractor.extract(clutter.view(), found);
    extractor.extract(noise.view(), found);
  }
  extractor.takeBackground();
  extractor.extract(empty.view(), found);
  EXPECT_EQ(g_allocations, before);
  EXPECT_TRUE(found.count == 0);
}

}  // namespace
}  // namespace helical
