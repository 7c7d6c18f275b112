#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/random.h"
#include "engine/cameras/frame.h"

namespace helical::test {

/// Pixels with an owner.
class Picture {
 public:
  Picture(int width, int height, PixelFormat format = PixelFormat::kBgr8, int padding_bytes = 0);

  ImageView view() const;
  /// A BGR picture as a camera of another format gives it: with exchanged bytes, as Bayer mosaic, or its
  /// green alone.
  Picture as(PixelFormat format, int padding_bytes = 0) const;
  std::uint8_t* pixel(int x, int y) { return pixels_.data() + y * stride_ + x * channels_; }
  int width() const { return width_; }
  int height() const { return height_; }
  int channels() const { return channels_; }

  void fill(int blue, int green, int red);
  /// A disc with anti-aliased edge, clipped to the image.
  void drawDisc(double x, double y, double radius, int blue, int green, int red);
  void addNoise(Random& random, double sigma);
  /// Every byte is drawn uniformly.
  void randomise(Random& random);
  void drawRandomBlocks(Random& random, int largest_side, double share_of_green);

  const std::uint8_t* pixel(int x, int y) const { return pixels_.data() + y * stride_ + x * channels_; }

 private:
  PixelFormat format_;
  int width_;
  int height_;
  int channels_;
  int stride_;
  std::vector<std::uint8_t> pixels_;
};

}  // namespace helical::test
