#include "engine/markers/mask_kernels.h"

// clang-format off: foreach_target.h includes this file once per instruction set.
#define HWY_WANT_AVX3_DL
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/markers/mask_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace helical {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<std::uint64_t, 8>;
using Words = hn::Vec<Tag>;

template <bool kErode>
HWY_INLINE Words merged(Words a, Words b) {
  return kErode ? hn::And(a, b) : hn::Or(a, b);
}

/// Of the words of one column in as many rows as a vector has lanes, each with the rows around it.
template <bool kErode>
HWY_INLINE Words alongColumn(const std::uint64_t* word, int reach) {
  const Tag d;
  Words result = hn::LoadU(d, word);
  for (int s = 1; s <= reach; ++s)
    result = merged<kErode>(result, merged<kErode>(hn::LoadU(d, word - s), hn::LoadU(d, word + s)));
  return result;
}

template <bool kErode>
HWY_INLINE Words alongRow(Words before, Words here, Words after, int reach) {
  Words result = here;
  for (int s = 1; s <= reach; ++s) {
    const Words from_left = hn::Or(hn::ShiftLeftSame(here, s), hn::ShiftRightSame(before, 64 - s));
    const Words from_right = hn::Or(hn::ShiftRightSame(here, s), hn::ShiftLeftSame(after, 64 - s));
    result = merged<kErode>(result, merged<kErode>(from_left, from_right));
  }
  return result;
}

template <bool kErode>
HWY_INLINE void spread(const MaskStep& step) {
  const Tag d;
  const int last = step.columns - 1;
  const Words outside = hn::Set(d, step.outside);
  const auto column = [&](int c, int y) HWY_ATTR {
    const Words words = alongColumn<kErode>(step.in + c * step.stride + y, step.reach);
    return kErode && c == last ? hn::Or(words, outside) : words;
  };
  for (int y = 0; y < step.rows; y += static_cast<int>(hn::Lanes(d))) {
    Words before = hn::Set(d, step.before), here = column(0, y);
    for (int c = 0; c <= last; ++c) {
      const Words after = c < last ? column(c + 1, y) : hn::Set(d, step.after);
      const Words words = alongRow<kErode>(before, here, after, step.reach);
      hn::StoreU(c == last ? hn::AndNot(outside, words) : words, d, step.out + c * step.stride + y);
      before = here;
      here = after;
    }
  }
}

void erode(const MaskStep& step) {
  spread<true>(step);
}

void dilate(const MaskStep& step) {
  spread<false>(step);
}

void mergeAlongRows(const MaskStep& step, std::uint64_t* merged) {
  const Tag d;
  for (int y = 0; y < step.rows; y += static_cast<int>(hn::Lanes(d))) {
    const std::uint64_t* word = step.in + y;
    Words all = hn::Set(d, ~std::uint64_t{0});
    for (int c = 0; c < step.columns - 1; ++c, word += step.stride) all = hn::And(all, hn::LoadU(d, word));
    hn::StoreU(hn::And(all, hn::Or(hn::LoadU(d, word), hn::Set(d, step.outside))), d, merged + y);
  }
}

void compareWithAbove(const MaskStep& step, std::uint64_t* changes) {
  const Tag d;
  for (int y = 0; y < step.rows; y += static_cast<int>(hn::Lanes(d))) {
    const std::uint64_t* word = step.in + y;
    Words changed = hn::Zero(d);
    for (int c = 0; c < step.columns; ++c, word += step.stride)
      changed = hn::Or(changed, hn::Xor(hn::LoadU(d, word), hn::LoadU(d, word - 1)));
    hn::StoreU(changed, d, changes + y);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace helical
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace helical {

HWY_EXPORT(erode);
HWY_EXPORT(dilate);
HWY_EXPORT(mergeAlongRows);
HWY_EXPORT(compareWithAbove);

void erodeColumns(const MaskStep& step) {
  HWY_DYNAMIC_DISPATCH(erode)(step);
}

void dilateColumns(const MaskStep& step) {
  HWY_DYNAMIC_DISPATCH(dilate)(step);
}

void mergeRows(const MaskStep& columns, std::uint64_t* merged) {
  HWY_DYNAMIC_DISPATCH(mergeAlongRows)(columns, merged);
}

void compareRows(const MaskStep& columns, std::uint64_t* changes) {
  HWY_DYNAMIC_DISPATCH(compareWithAbove)(columns, changes);
}

}  // namespace helical
#endif
