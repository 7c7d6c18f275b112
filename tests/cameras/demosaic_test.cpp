#include "engine/cameras/demosaic.h"

#include <gtest/gtest.h>

#include <array>

namespace helical {
namespace {

constexpr int kWidth = 16, kHeight = 12;
constexpr std::array<std::uint8_t, 3> kBlueGreenRed{40, 120, 200};

/// One colour all over, through the filter whose four pixels these channels of BGR are.
std::vector<std::uint8_t> mosaic(const std::array<std::size_t, 4>& filter) {
  std::vector<std::uint8_t> pixels;
  for (std::size_t y = 0; y < kHeight; ++y)
    for (std::size_t x = 0; x < kWidth; ++x) pixels.push_back(kBlueGreenRed[filter[2 * (y % 2) + x % 2]]);
  return pixels;
}

TEST(Demosaic, GivesBackTheColourOfEveryFilter) {
  const std::pair<PixelFormat, std::array<std::size_t, 4>> filters[] = {
      {PixelFormat::kBayerRg8, {2, 1, 1, 0}},
      {PixelFormat::kBayerGr8, {1, 2, 0, 1}},
      {PixelFormat::kBayerGb8, {1, 0, 2, 1}},
      {PixelFormat::kBayerBg8, {0, 1, 1, 2}},
  };
  for (const auto& [format, filter] : filters) {
    const auto pixels = mosaic(filter);
    std::vector<std::uint8_t> bgr;
    toBgr({pixels.data(), kWidth, kHeight, kWidth, format}, bgr);
    ASSERT_EQ(bgr.size(), 3U * kWidth * kHeight);
    for (std::size_t i = 0; i < bgr.size(); ++i) ASSERT_EQ(bgr[i], kBlueGreenRed[i % 3]) << i;
  }
}

TEST(Demosaic, KeepsToTheRowsOfWiderPictures) {
  const std::vector<std::uint8_t> pixels{1, 2, 3, 9, 9, 4, 5, 6, 9, 9};  // two rows of one pixel, five bytes apart
  std::vector<std::uint8_t> bgr;
  toBgr({pixels.data(), 1, 2, 5, PixelFormat::kRgb8}, bgr);
  EXPECT_EQ(bgr, (std::vector<std::uint8_t>{3, 2, 1, 6, 5, 4}));
  toBgr({pixels.data(), 1, 2, 5, PixelFormat::kBgr8}, bgr);
  EXPECT_EQ(bgr, (std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6}));
  toBgr({pixels.data(), 1, 2, 5, PixelFormat::kMono8}, bgr);
  EXPECT_EQ(bgr, (std::vector<std::uint8_t>{1, 1, 1, 4, 4, 4}));
}

}  // namespace
}  // namespace helical
