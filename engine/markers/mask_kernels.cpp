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

/// One vector of `D`, or the last words one by one.
template <bool kErode, class D>
HWY_INLINE void spread(D d, const std::uint64_t* line, int reach, std::uint64_t* out) {
  const auto here = hn::LoadU(d, line), before = hn::LoadU(d, line - 1), after = hn::LoadU(d, line + 1);
  auto result = here;
  for (int s = 1; s <= reach; ++s) {
    const auto from_left = hn::Or(hn::ShiftLeftSame(here, s), hn::ShiftRightSame(before, 64 - s));
    const auto from_right = hn::Or(hn::ShiftRightSame(here, s), hn::ShiftLeftSame(after, 64 - s));
    if constexpr (kErode)
      result = hn::And(result, hn::And(from_left, from_right));
    else
      result = hn::Or(result, hn::Or(from_left, from_right));
  }
  hn::StoreU(result, d, out);
}

template <bool kErode>
HWY_INLINE void spreadLine(const std::uint64_t* line, int count, int reach, std::uint64_t* out) {
  const hn::CappedTag<std::uint64_t, 8> d;
  const hn::CappedTag<std::uint64_t, 1> one;
  const int step = static_cast<int>(hn::Lanes(d));
  int w = 0;
  for (; w + step <= count; w += step) spread<kErode>(d, line + w, reach, out + w);
  for (; w < count; ++w) spread<kErode>(one, line + w, reach, out + w);
}

void erode(const std::uint64_t* line, int count, int reach, std::uint64_t* out) {
  spreadLine<true>(line, count, reach, out);
}

void dilate(const std::uint64_t* line, int count, int reach, std::uint64_t* out) {
  spreadLine<false>(line, count, reach, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace helical
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace helical {

HWY_EXPORT(erode);
HWY_EXPORT(dilate);

void erodeLine(const std::uint64_t* line, int count, int reach, std::uint64_t* out) {
  HWY_DYNAMIC_DISPATCH(erode)(line, count, reach, out);
}

void dilateLine(const std::uint64_t* line, int count, int reach, std::uint64_t* out) {
  HWY_DYNAMIC_DISPATCH(dilate)(line, count, reach, out);
}

}  // namespace helical
#endif
