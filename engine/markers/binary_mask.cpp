#include "engine/markers/binary_mask.h"

#include <algorithm>

#include "engine/markers/mask_kernels.h"

namespace helical {
namespace {

constexpr std::uint64_t kAll = ~std::uint64_t{0};

}  // namespace

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
  line_.assign(static_cast<std::size_t>(words_) + 2, 0);
}

WordRect BinaryMask::clip(const WordRect& rect) const {
  return {std::max(0, rect.top), std::min(height_ - 1, rect.bottom), std::max(0, rect.left),
          std::min(words_ - 1, rect.right)};
}

void BinaryMask::clear(const WordRect& rect) {
  for (int y = rect.top; y <= rect.bottom; ++y)
    std::fill(row(y) + rect.left, row(y) + rect.right + 1, std::uint64_t{0});
}

std::uint64_t BinaryMask::lastWordMask() const {
  const int used = width_ % 64;
  return used == 0 ? kAll : (std::uint64_t{1} << used) - 1;
}

void BinaryMask::erode(const BinaryMask& source, int reach, const WordRect& rect) {
  std::uint64_t* line = line_.data() + 1;
  const int left = rect.left, right = rect.right;
  const bool at_right = right == words_ - 1;
  for (int y = rect.top; y <= rect.bottom; ++y) {
    std::uint64_t* out = row(y);
    const int above = std::max(0, y - reach), below = std::min(height_ - 1, y + reach);
    if (above < rect.top || below > rect.bottom) {
      std::fill(out + left, out + right + 1, std::uint64_t{0});
      continue;
    }
    std::copy(source.row(above) + left, source.row(above) + right + 1, line + left);
    for (int i = above + 1; i <= below; ++i)
      for (int w = left; w <= right; ++w) line[w] &= source.row(i)[w];
    line[left - 1] = left == 0 ? kAll : 0;
    line[right + 1] = at_right ? kAll : 0;
    if (at_right) line[right] |= ~lastWordMask();
    erodeLine(line + left, right - left + 1, reach, out + left);
    if (at_right) out[right] &= lastWordMask();
  }
}

void BinaryMask::dilate(const BinaryMask& source, int reach, const WordRect& rect) {
  std::uint64_t* line = line_.data() + 1;
  const int left = rect.left, right = rect.right;
  for (int y = rect.top; y <= rect.bottom; ++y) {
    const int above = std::max(rect.top, y - reach), below = std::min(rect.bottom, y + reach);
    std::copy(source.row(above) + left, source.row(above) + right + 1, line + left);
    for (int i = above + 1; i <= below; ++i)
      for (int w = left; w <= right; ++w) line[w] |= source.row(i)[w];
    line[left - 1] = line[right + 1] = 0;
    std::uint64_t* out = row(y);
    dilateLine(line + left, right - left + 1, reach, out + left);
    if (right == words_ - 1) out[right] &= lastWordMask();
  }
}

}  // namespace helical
