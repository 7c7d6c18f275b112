#include "engine/markers/cell_scatter.h"

#include <algorithm>
#include <cmath>

#include "engine/markers/disc_normal.h"

// clang-format off: foreach_target.h includes this file once per instruction set.
#define HWY_WANT_AVX3_DL
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/markers/cell_scatter.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace helical {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, kDiscLanes>;
using Floats = hn::Vec<Tag>;

constexpr int kHalvings = 14;

struct Range {
  float least, most;
};

HWY_INLINE Range rangeOf(const float* values, std::size_t count) {
  const Tag d;
  Range range{values[0], values[0]};
  std::size_t i = 0;
  if (count >= hn::Lanes(d)) {
    Floats least = hn::LoadU(d, values), most = least;
    for (i = hn::Lanes(d); i + hn::Lanes(d) <= count; i += hn::Lanes(d)) {
      least = hn::Min(least, hn::LoadU(d, values + i));
      most = hn::Max(most, hn::LoadU(d, values + i));
    }
    range = {hn::GetLane(hn::MinOfLanes(d, least)), hn::GetLane(hn::MaxOfLanes(d, most))};
  }
  for (; i < count; ++i) range = {std::min(range.least, values[i]), std::max(range.most, values[i])};
  return range;
}

/// Counted as floats, which are exact that far.
HWY_INLINE std::size_t countBelow(const float* values, std::size_t count, float limit) {
  const Tag d;
  const Floats least = hn::Set(d, limit), one = hn::Set(d, 1.0F);
  Floats below = hn::Zero(d);
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d))
    below = below + hn::IfThenElseZero(hn::Lt(hn::LoadU(d, values + i), least), one);
  auto total = static_cast<std::size_t>(hn::GetLane(hn::SumOfLanes(d, below)));
  for (; i < count; ++i) total += values[i] < limit ? 1 : 0;
  return total;
}

float rankIn(const float* values, std::size_t count, std::size_t rank) {
  auto [low, high] = rangeOf(values, count);
  for (int i = 0; i < kHalvings && low < high; ++i) {
    const float middle = 0.5F * (low + high);
    (countBelow(values, count, middle) <= rank ? low : high) = middle;
  }
  return low;
}

}  // namespace HWY_NAMESPACE
}  // namespace helical
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace helical {
namespace {

constexpr float kSigmaOverMedian = 1.4826F;  ///< of what is normally distributed, without its sign

/// Of the residuals of the cells that are asked for.
template <class IsWanted>
float scatterOf(const DiscCells& cells, std::span<float> room, IsWanted isWanted) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < cells.count; ++i) {
    room[count] = std::abs(cells.residual[i]);
    count += isWanted(i) ? 1 : 0;
  }
  return count > 0 ? std::max(kLeastScale, kSigmaOverMedian * medianOf(room.first(count))) : kLeastScale;
}

}  // namespace

HWY_EXPORT(rankIn);

float valueOfRank(std::span<const float> values, std::size_t rank) {
  return HWY_DYNAMIC_DISPATCH(rankIn)(values.data(), values.size(), rank);
}

float residualScale(const DiscCells& cells, std::span<float> room) {
  return scatterOf(cells, room, [&](std::size_t i) { return cells.given[i] != 0.0F; });
}

float noiseAround(const DiscCells& cells, std::span<float> room) {
  return scatterOf(cells, room,
                   [&](std::size_t i) { return cells.given[i] != 0.0F && cells.cover[i] == 0.0F; });
}

}  // namespace helical
#endif
