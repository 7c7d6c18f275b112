#include "app/bench_read.h"

// clang-format off: foreach_target.h includes this file once per instruction set.
#define HWY_WANT_AVX3_DL
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "app/bench_read.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace helical {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

std::uint64_t sumAllBytes(const std::uint8_t* bytes, std::size_t count) {
  const hn::CappedTag<std::uint64_t, 8> d;
  const std::size_t step = hn::Lanes(d) * sizeof(std::uint64_t);
  auto a = hn::Zero(d), b = a, c = a, e = a;
  const auto load = [&](std::size_t at)
                        HWY_ATTR { return hn::LoadU(d, reinterpret_cast<const std::uint64_t*>(bytes + at)); };
  std::size_t i = 0;
  for (; i + 4 * step <= count; i += 4 * step) {
    a = hn::Add(a, load(i));
    b = hn::Add(b, load(i + step));
    c = hn::Add(c, load(i + 2 * step));
    e = hn::Add(e, load(i + 3 * step));
  }
  std::uint64_t rest = 0;
  for (; i < count; ++i) rest += bytes[i];
  return rest + hn::GetLane(hn::SumOfLanes(d, hn::Add(hn::Add(a, b), hn::Add(c, e))));
}

}  // namespace HWY_NAMESPACE
}  // namespace helical
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace helical {

HWY_EXPORT(sumAllBytes);

std::uint64_t sumOfBytes(const std::uint8_t* bytes, std::size_t count) {
  return HWY_DYNAMIC_DISPATCH(sumAllBytes)(bytes, count);
}

}  // namespace helical
#endif
