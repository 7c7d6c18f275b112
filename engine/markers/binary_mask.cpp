#include "engine/markers/binary_mask.h"

#include <algorithm>

namespace helical {
void WordRect::include(const WordRect& other) {
  if (isEmpty()) {
    *this = other;
    return;
  }
  top = std::min(top, other.top);
  bottom = std::max(bottom, other.bottom);
  left = std::min(left, other.left);
  right = std::max(right, other.right);
}

WordRect WordRect::grown(int rows, int words) const {
  return {top - rows, bottom + rows, left - words, right + words};
}

bool WordRect::overlaps(const WordRect& other) const {
  return top <= other.bottom && other.top <= bottom && left <= other.right && other.left <= right;
}

void BinaryMask::resize(int width, int height) {
  width_ = width;
  height_ = height;
  words_ = (width + 63) / 64;
  bits_.assign(static_cast<std::size_t>(words_) * static_cast<std::size_t>(height), 0);
}

WordRect BinaryMask::clip(const WordRect& rect) const {
  return {std::max(0, rect.top), std::min(height_ - 1, rect.bottom), std::max(0, rect.left),
          std::min(words_ - 1, rect.right)};
}

void BinaryMask::clear(const WordRect& rect) {
  for (int y = rect.top; y <= rect.bottom; ++y)
    std::fill(row(y) + rect.left, row(y) + rect.right + 1, std::uint64_t{0});
}

}  // namespace helical
