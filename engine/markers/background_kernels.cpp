#include "engine/markers/background_kernels.h"

// clang-format off: foreach_target.h includes this file once per instruction set.
#define HWY_WANT_AVX3_DL
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/markers/background_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace helical {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

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

}  // namespace HWY_NAMESPACE
}  // namespace helical
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace helical {

HWY_EXPORT(moveAll);

void moveTowards(const std::uint8_t* seen, std::size_t count, std::uint8_t most, std::uint8_t* mean) {
  HWY_DYNAMIC_DISPATCH(moveAll)(seen, count, most, mean);
}

}  // namespace helical
#endif
