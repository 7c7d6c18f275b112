#include "engine/markers/binary_mask.h"

#include <algorithm>

namespace helical {

void BinaryMask::resize(int width, int height) {
  width_ = width;
  height_ = height;
  words_ = (width + 63) / 64;
  bits_.assign(static_cast<std::size_t>(words_) * static_cast<std::size_t>(height), 0);
  line_.assign(static_cast<std::size_t>(words_) + 2, 0);
  setBand(0, -1);
}

void BinaryMask::setBand(int first, int last) {
  first_row_ = std::max(0, first);
  last_row_ = std::min(height_ - 1, last);
}

std::uint64_t BinaryMask::lastWordMask() const {
  const int used = width_ % 64;
  return used == 0 ? ~std::uint64_t{0} : (std::uint64_t{1} << used) - 1;
}

void BinaryMask::erode(const BinaryMask& source, int reach) {
  setBand(source.firstRow(), source.lastRow());
  const auto words = static_cast<std::size_t>(words_);
  std::uint64_t* line = line_.data() + 1;
  for (int y = first_row_; y <= last_row_; ++y) {
    std::uint64_t* out = row(y);
    const int above = std::max(0, y - reach), below = std::min(height_ - 1, y + reach);
    if (above < source.firstRow() || below > source.lastRow()) {
      std::fill_n(out, words, 0);
      continue;
    }
    std::copy_n(source.row(above), words, line);
    for (int i = above + 1; i <= below; ++i)
      for (std::size_t w = 0; w < words; ++w) line[w] &= source.row(i)[w];
    line[-1] = line[words] = ~std::uint64_t{0};
    line[words - 1] |= ~lastWordMask();
    for (std::size_t w = 0; w < words; ++w) {
      std::uint64_t kept = line[w];
      for (int s = 1; kept != 0 && s <= reach; ++s)
        kept &= (line[w] << s | line[w - 1] >> (64 - s)) & (line[w] >> s | line[w + 1] << (64 - s));
      out[w] = kept;
    }
    out[words - 1] &= lastWordMask();
  }
}

void BinaryMask::dilate(const BinaryMask& source, int reach) {
  setBand(source.firstRow() - reach, source.lastRow() + reach);
  const auto words = static_cast<std::size_t>(words_);
  std::uint64_t* line = line_.data() + 1;
  line[-1] = line[words] = 0;
  for (int y = first_row_; y <= last_row_; ++y) {
    std::fill_n(line, words, 0);
    const int above = std::max(source.firstRow(), y - reach), below = std::min(source.lastRow(), y + reach);
    for (int i = above; i <= below; ++i)
      for (std::size_t w = 0; w < words; ++w) line[w] |= source.row(i)[w];
    std::uint64_t* out = row(y);
    for (std::size_t w = 0; w < words; ++w) {
      std::uint64_t grown = line[w];
      if ((line[w] | line[w - 1] | line[w + 1]) != 0)
        for (int s = 1; s <= reach; ++s)
          grown |= line[w] << s | line[w - 1] >> (64 - s) | line[w] >> s | line[w + 1] << (64 - s);
      out[w] = grown;
    }
    out[words - 1] &= lastWordMask();
  }
}

}  // namespace helical
