#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/markers/background_ranges.h"

namespace helical {

/// Moves each byte of `mean` by one towards that of `seen`, where the two differ by no more than `most`. In
/// the instructions of the machine; the same bytes in each set.
void moveTowards(const std::uint8_t* seen, std::size_t count, std::uint8_t most, std::uint8_t* mean);

/// Takes the cells of a row into the ranges of their words, one for each 64.
void includeRow(const CellGrid& grid, int y, CellRange* ranges);

}  // namespace helical
