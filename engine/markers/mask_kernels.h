#pragma once

#include <cstddef>
#include <cstdint>

namespace helical {

/// One erosion or dilation of columns of 64-cell words, each `rows` long. `reach` words before and behind
/// each column of `in` are read as what lies there, and what lies up to 7 words behind one of `out` is
/// overwritten.
struct MaskStep {
  const std::uint64_t* in = nullptr;  ///< the first column's first word; the next one's is `stride` words on
  std::uint64_t* out = nullptr;       ///< laid out alike
  std::ptrdiff_t stride = 0;
  int rows = 0;
  int columns = 0;
  int reach = 0;              ///< at most 7
  std::uint64_t before = 0;   ///< what the words left of the first column hold
  std::uint64_t after = 0;    ///< and right of the last
  std::uint64_t outside = 0;  ///< cells of the last column outside of the image: unset afterwards
};

/// Each cell becomes the and, or the or, of the square of side 2 `reach` + 1 around it; `outside` counts as
/// set for the erosion. In the instructions of the machine; the same bits in each set.
void erodeColumns(const MaskStep& step);
void dilateColumns(const MaskStep& step);

/// For each row of columns that are laid out like a step's: the and of its words, `outside` counting as set.
void mergeRows(const MaskStep& columns, std::uint64_t* merged);
/// For each row: 0 where all its words are like those of the row above.
void compareRows(const MaskStep& columns, std::uint64_t* changes);

}  // namespace helical
