#pragma once

#include <cstddef>
#include <span>

#include "engine/markers/disc_kernels.h"

namespace helical {

/// That which stands at `rank` (0: the least) were they in order, or less than 1/16000 of their range
/// below it. The same in every instruction set.
float valueOfRank(std::span<const float> values, std::size_t rank);
inline float medianOf(std::span<const float> values) {
  return valueOfRank(values, values.size() / 2);
}

/// Standard deviations of the given cells' residuals, by their median: of all of them, and of those that the
/// disc does not cover. `room` is for as many values as there are cells.
float residualScale(const DiscCells& cells, std::span<float> room);
float noiseAround(const DiscCells& cells, std::span<float> room);

}  // namespace helical
