#pragma once

#include <cstdint>
#include <vector>

namespace helical {

/// One bit a pixel, 64 to a word, with the band of rows outside of which everything is zero. Morphology works
/// on whole words. Allocates in `resize` only.
class BinaryMask {
 public:
  void resize(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  int wordsPerRow() const { return words_; }
  std::uint64_t* row(int y) { return bits_.data() + static_cast<std::ptrdiff_t>(y) * words_; }
  const std::uint64_t* row(int y) const { return bits_.data() + static_cast<std::ptrdiff_t>(y) * words_; }

  /// Rows outside [first, last] are empty, whatever their words hold. An empty band: last < first.
  int firstRow() const { return first_row_; }
  int lastRow() const { return last_row_; }
  void setBand(int first, int last);

  /// Sets this to the erosion or dilation of `source` with a square of side 2 `reach` + 1, `reach` at most 7.
  /// As in OpenCV, pixels outside the image never decide: they count as set for the erosion, as unset for the
  /// dilation. The band is that of `source`.
  void erode(const BinaryMask& source, int reach);
  void dilate(const BinaryMask& source, int reach);

 private:
  std::uint64_t lastWordMask() const;

  int width_ = 0;
  int height_ = 0;
  int words_ = 0;
  int first_row_ = 0;
  int last_row_ = -1;
  std::vector<std::uint64_t> bits_;
  std::vector<std::uint64_t> line_;  ///< one row after the vertical pass, a word of border on both sides
};

}  // namespace helical
