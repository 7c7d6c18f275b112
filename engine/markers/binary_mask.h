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

/// One bit a cell, 64 to a word. Allocates in `resize` only.
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

 private:
  int width_ = 0;
  int height_ = 0;
  int words_ = 0;
  std::vector<std::uint64_t> bits_;
};

}  // namespace helical
