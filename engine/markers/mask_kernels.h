#pragma once

#include <cstdint>

namespace helical {

/// The horizontal part of erosion and dilation with a square of side 2 `reach` + 1, at most 7: each cell of
/// `count` words becomes the and, or the or, of the cells up to `reach` beside it. The words before and after
/// `line` are read, too. In the instructions of the machine; the same bits in each set.
void erodeLine(const std::uint64_t* line, int count, int reach, std::uint64_t* out);
void dilateLine(const std::uint64_t* line, int count, int reach, std::uint64_t* out);

}  // namespace helical
