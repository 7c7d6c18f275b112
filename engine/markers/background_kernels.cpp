#include "engine/markers/background_kernels.h"

#include <algorithm>
#include <array>
#include <cstring>

// clang-format off: foreach_target.h includes this file once per instruction set.
#define HWY_WANT_AVX3_DL
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/markers/background_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/markers/cell_loading.inc"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace helical {
namespace HWY_NAMESPACE {

void moveAll(const std::uint8_t* seen, std::size_t count, std::uint8_t most, std::uint8_t* mean) {
  const hn::ScalableTag<std::uint8_t> d;
  const auto one = hn::Set(d, 1), limit = hn::Set(d, most), zero = hn::Zero(d);
  std::size_t i = 0;
  for (const std::size_t step = hn::Lanes(d); i + step <= count; i += step) {
    const auto x = hn::LoadU(d, seen + i), m = hn::LoadU(d, mean + i);
    const auto above = hn::SaturatedSub(x, m), below = hn::SaturatedSub(m, x);
    const auto is_near = hn::Eq(hn::SaturatedSub(hn::Or(above, below), limit), zero);
    const auto up = hn::IfThenElseZero(is_near, hn::Min(above, one));
    const auto down = hn::IfThenElseZero(is_near, hn::Min(below, one));
    hn::StoreU(hn::Sub(hn::Add(m, up), down), d, mean + i);
  }
  for (; i < count; ++i) {
    const int difference = seen[i] - mean[i];
    if (difference > 0 && difference <= most) ++mean[i];
    if (difference < 0 && -difference <= most) --mean[i];
  }
}

#if HWY_TARGET == HWY_SCALAR
HWY_INLINE std::uint8_t leastOf(Bytes bytes) {
  return hn::GetLane(bytes);
}
#else
HWY_INLINE std::uint8_t leastOf(Bytes bytes) {
  const hn::RepartitionToWide<Tag> d;
  const auto pairs = hn::BitCast(d, bytes);
  const auto least = hn::Min(hn::And(pairs, hn::Set(d, 255)), hn::ShiftRight<8>(pairs));
  return static_cast<std::uint8_t>(hn::GetLane(hn::MinOfLanes(d, least)));
}
#endif

HWY_INLINE std::uint8_t largestOf(Bytes bytes) {
  return static_cast<std::uint8_t>(255 - leastOf(hn::Sub(broadcast(255), bytes)));
}

HWY_INLINE void widen(CellRange& range, std::size_t channel, Bytes low, Bytes high) {
  range.low[channel] = std::min(range.low[channel], leastOf(low));
  range.high[channel] = std::max(range.high[channel], largestOf(high));
}

/// The cells of whole words; returns how many words these are.
template <CellLayout L>
HWY_INLINE int includeWords(const CellGrid& grid, int y, CellRange* ranges) {
  const int words = grid.width / 64;
  const std::size_t lanes = hn::Lanes(Tag());
  for (int w = 0; w < words; ++w) {
    const std::uint8_t* first = grid.row(y) + static_cast<std::ptrdiff_t>(w) * 64 * kBytesPerCell<L>;
    const Place place{first, first + grid.second_row};
    if constexpr (L == CellLayout::kBytes) {
      Bytes low = broadcast(255), high = broadcast(0);
      for (std::size_t cell = 0; cell < 64; cell += lanes) {
        const Bytes v = hn::LoadU(Tag(), first + cell);
        low = hn::Min(low, v), high = hn::Max(high, v);
      }
      widen(ranges[w], 0, low, high);
    } else {
      Colours low = loadColours<L>(place, 0), high = low;
      for (std::size_t cell = lanes; cell < 64; cell += lanes) {
        const Colours c = loadColours<L>(place, cell);
        low = {hn::Min(low.first, c.first), hn::Min(low.green, c.green), hn::Min(low.last, c.last)};
        high = {hn::Max(high.first, c.first), hn::Max(high.green, c.green), hn::Max(high.last, c.last)};
      }
      widen(ranges[w], 0, low.first, high.first);
      widen(ranges[w], 1, low.green, high.green);
      widen(ranges[w], 2, low.last, high.last);
    }
  }
  return words;
}

int includeWholeWords(const CellGrid& grid, int y, CellRange* ranges) {
  switch (grid.layout) {
    case CellLayout::kBytes:
      return includeWords<CellLayout::kBytes>(grid, y, ranges);
    case CellLayout::kTriples:
      return includeWords<CellLayout::kTriples>(grid, y, ranges);
    case CellLayout::kQuadsColourFirst:
      return includeWords<CellLayout::kQuadsColourFirst>(grid, y, ranges);
    case CellLayout::kQuadsGreenFirst:
      return includeWords<CellLayout::kQuadsGreenFirst>(grid, y, ranges);
  }
  return 0;
}

}  // namespace HWY_NAMESPACE
}  // namespace helical
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace helical {

HWY_EXPORT(moveAll);
HWY_EXPORT(includeWholeWords);

void moveTowards(const std::uint8_t* seen, std::size_t count, std::uint8_t most, std::uint8_t* mean) {
  HWY_DYNAMIC_DISPATCH(moveAll)(seen, count, most, mean);
}

void includeRow(const CellGrid& grid, int y, CellRange* ranges) {
  const int words = HWY_DYNAMIC_DISPATCH(includeWholeWords)(grid, y, ranges);
  for (int x = 64 * words; x < grid.width; ++x) {
    std::uint8_t values[3] = {};
    readCell(grid, x, y, values);
    CellRange& range = ranges[words];
    for (std::size_t i = 0; i < 3; ++i) {
      range.low[i] = std::min(range.low[i], values[i]);
      range.high[i] = std::max(range.high[i], values[i]);
    }
  }
}

}  // namespace helical
#endif
