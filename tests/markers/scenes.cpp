#include "tests/markers/scenes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace helical::test {
namespace {

std::uint8_t grey(double value) {
  return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
}

/// Which of blue, green, red a sensor's pixel measures; green where there is no mosaic.
int mosaicChannel(PixelFormat format, int x, int y) {
  constexpr int kBlue = 0, kGreen = 1, kRed = 2;
  const bool odd_x = x % 2 != 0, odd_y = y % 2 != 0;
  switch (format) {
    case PixelFormat::kBayerRg8:
      return odd_x != odd_y ? kGreen : odd_y ? kBlue : kRed;
    case PixelFormat::kBayerBg8:
      return odd_x != odd_y ? kGreen : odd_y ? kRed : kBlue;
    case PixelFormat::kBayerGr8:
      return odd_x == odd_y ? kGreen : odd_y ? kBlue : kRed;
    case PixelFormat::kBayerGb8:
      return odd_x == odd_y ? kGreen : odd_y ? kRed : kBlue;
    default:
      return kGreen;
  }
}

}  // namespace

Picture::Picture(int width, int height, PixelFormat format, int padding_bytes)
    : format_(format),
      width_(width),
      height_(height),
      channels_(format == PixelFormat::kBgr8 || format == PixelFormat::kRgb8 ? 3 : 1),
      stride_(width * channels_ + padding_bytes),
      // The last row ends with its last pixel: readers that run over it are found by the address sanitizer.
      pixels_(static_cast<std::size_t>(stride_ * (height - 1) + width * channels_)) {}

ImageView Picture::view() const {
  return {pixels_.data(), width_, height_, stride_, format_};
}

Picture Picture::as(PixelFormat format, int padding_bytes) const {
  Picture other(width_, height_, format, padding_bytes);
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      const std::uint8_t* bgr = pixel(x, y);
      std::uint8_t* out = other.pixel(x, y);
      if (format == PixelFormat::kBgr8) std::copy_n(bgr, 3, out);
      if (format == PixelFormat::kRgb8) std::reverse_copy(bgr, bgr + 3, out);
      if (other.channels_ == 1) out[0] = bgr[mosaicChannel(format, x, y)];
    }
  return other;
}

void Picture::fill(int blue, int green, int red) {
  const std::array<int, 3> colour{blue, green, red};
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      for (int c = 0; c < channels_; ++c) pixel(x, y)[c] = grey(colour[static_cast<std::size_t>(c)]);
}

void Picture::drawDisc(double cx, double cy, double radius, int blue, int green, int red) {
  const std::array<int, 3> colour{blue, green, red};
  for (int y = std::max(0, static_cast<int>(cy - radius) - 1); y < std::min<double>(height_, cy + radius + 2);
       ++y)
    for (int x = std::max(0, static_cast<int>(cx - radius) - 1);
         x < std::min<double>(width_, cx + radius + 2); ++x) {
      const double cover = std::clamp(radius + 0.5 - std::hypot(x - cx, y - cy), 0.0, 1.0);
      for (int c = 0; c < channels_; ++c) {
        std::uint8_t& value = pixel(x, y)[c];
        value = grey((1.0 - cover) * value + cover * colour[static_cast<std::size_t>(c)]);
      }
    }
}

void Picture::addNoise(Random& random, double sigma) {
  for (auto& value : pixels_) value = grey(value + sigma * random.normal());
}

void Picture::randomise(Random& random) {
  for (auto& value : pixels_) value = static_cast<std::uint8_t>(random.bits() >> 56);
}

void Picture::drawRandomBlocks(Random& random, int largest_side, double share_of_green) {
  for (int n = 0; n < width_ * height_ / 40; ++n) {
    const int left = static_cast<int>(random.uniform(0, width_)),
              top = static_cast<int>(random.uniform(0, height_));
    const int w = 1 + static_cast<int>(random.uniform(0, largest_side));
    const int h = 1 + static_cast<int>(random.uniform(0, largest_side));
    const bool is_green = random.uniform() < share_of_green;
    const std::array<double, 3> colour{random.uniform(0, is_green ? 80 : 255),
                                       random.uniform(is_green ? 150 : 0, 255),
                                       random.uniform(0, is_green ? 80 : 255)};
    for (int y = top; y < std::min(height_, top + h); ++y)
      for (int x = left; x < std::min(width_, left + w); ++x)
        for (int c = 0; c < channels_; ++c) pixel(x, y)[c] = grey(colour[static_cast<std::size_t>(c)]);
  }
}

}  // namespace helical::test
