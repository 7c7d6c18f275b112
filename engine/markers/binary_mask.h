#pragma once

#include <cstdint>
#include <vector>

namespace helical {

/// Some rows and 64-cell words of a mask; all four are inside.
struct WordRect {
  int top = 0;
  int bottom = -1;
  int left = 0;
  int right = -1;

  bool isEmpty() const { return bottom < top || right < left; }
  void include(const WordRect& other);
  /// Grown by rows above and below and words on both sides.
  WordRect grown(int rows, int words) const;
  bool overlaps(const WordRect& other) const;
};

/// One bit a cell, 64 to a word. Morphology works on whole words, inside of a rectangle. Allocates in
/// `resize` only.
class BinaryMask {
 public:
  void resize(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  int wordsPerRow() const { return words_; }
  std::uint64_t* row(int y) { return bits_.data() + static_cast<std::ptrdiff_t>(y) * words_; }
  const std::uint64_t* row(int y) const { return bits_.data() + static_cast<std::ptrdiff_t>(y) * words_; }
  bool at(int x, int y) const { return (row(y)[x / 64] >> (x % 64) & 1U) != 0; }

  WordRect everywhere() const { return {0, height_ - 1, 0, words_ - 1}; }
  WordRect clip(const WordRect& rect) const;
  void clear(const WordRect& rect);

  /// Sets the rectangle (inside of the mask) to the erosion or dilation of `source` with a square of side 2
  /// `reach` + 1, `reach` at most 7. As in OpenCV, cells outside of the image never decide: they count as set
  /// for the erosion, as unset for the dilation. What `source` holds outside of the rectangle counts as
  /// unset.
  void erode(const BinaryMask& source, int reach, const WordRect& rect);
  void dilate(const BinaryMask& source, int reach, const WordRect& rect);

 private:
  std::uint64_t lastWordMask() const;

  int width_ = 0;
  int height_ = 0;
  int words_ = 0;
  std::vector<std::uint64_t> bits_;
  std::vector<std::uint64_t> line_;  ///< one row after the vertical pass, a word of border on both sides
};

}  // namespace helical
