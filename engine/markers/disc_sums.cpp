#include "engine/markers/disc_kernels.h"

#include <algorithm>

// clang-format off: foreach_target.h includes this file once per instruction set.
#define HWY_WANT_AVX3_DL
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/markers/disc_sums.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace helical {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<float, kDiscLanes>;
using Floats = hn::Vec<Tag>;

HWY_INLINE Floats all(float value) {
  return hn::Set(Tag(), value);
}

/// Sums over the given cells of value a b for one a and each b, always over kDiscLanes partial sums.
template <std::size_t kCount, class A, class B>
HWY_INLINE std::array<double, kCount> sumsOver(const DiscCells& cells, A a, B b) {
  const Tag d;
  alignas(64) std::array<std::array<float, kDiscLanes>, kCount> lanes;
  for (std::size_t k = 0; k < kDiscLanes; k += hn::Lanes(d)) {
    Floats sums[kCount];
    for (std::size_t j = 0; j < kCount; ++j) sums[j] = hn::Zero(d);
    for (std::size_t i = k; i < cells.count; i += kDiscLanes) {
      const Floats weighted = hn::Load(d, &cells.given[i]) * a(i);
      for (std::size_t j = 0; j < kCount; ++j) sums[j] = sums[j] + weighted * b(i, j);
    }
    for (std::size_t j = 0; j < kCount; ++j) hn::Store(sums[j], d, &lanes[j][k]);
  }
  std::array<double, kCount> totals{};
  for (std::size_t j = 0; j < kCount; ++j)
    for (const float lane : lanes[j]) totals[j] += static_cast<double>(lane);
  return totals;
}

/// Row `kRow` of the normal equations, and those after it as far as `kRows`.
template <std::size_t kRows, std::size_t kRow = 0>
HWY_INLINE void sumRows(const DiscCells& cells, DiscSums& sums) {
  if constexpr (kRow < kRows) {
    const auto slope = [&](std::size_t i) HWY_ATTR { return hn::Load(Tag(), &cells.slope[kRow][i]); };
    const auto other = [&](std::size_t i, std::size_t j) HWY_ATTR {
      return hn::Load(Tag(), j > kRow ? &cells.residual[i] : &cells.slope[j][i]);
    };
    const auto totals = sumsOver<kRow + 2>(cells, slope, other);
    std::copy_n(totals.begin(), kRow + 1, sums.normal[kRow].begin());
    sums.gradient[kRow] = totals[kRow + 1];
    sumRows<kRows, kRow + 1>(cells, sums);
  }
}

template <std::size_t kRows>
HWY_INLINE void sumAll(const DiscCells& cells, DiscSums& sums) {
  sumRows<kRows>(cells, sums);
  const auto one = [](std::size_t) HWY_ATTR { return all(1.0F); };
  const auto residual = [&](std::size_t i) HWY_ATTR { return hn::Load(Tag(), &cells.residual[i]); };
  sums.count = sumsOver<1>(cells, one, [](std::size_t, std::size_t) HWY_ATTR { return all(1.0F); })[0];
  sums.squares =
      sumsOver<1>(cells, residual, [&](std::size_t i, std::size_t) HWY_ATTR { return residual(i); })[0];
}

void sumAllOfDisc(const DiscCells& cells, DiscSums& sums) {
  sumAll<kDiscParameters>(cells, sums);
}

void sumAllOfSmearedDisc(const DiscCells& cells, DiscSums& sums) {
  sumAll<kSmearParameters>(cells, sums);
}

void sumAllOfCutDisc(const DiscCells& cells, DiscSums& sums) {
  sumAll<kCutParameters>(cells, sums);
}

}  // namespace HWY_NAMESPACE
}  // namespace helical
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace helical {

HWY_EXPORT(sumAllOfDisc);
HWY_EXPORT(sumAllOfCutDisc);
HWY_EXPORT(sumAllOfSmearedDisc);

void sumDisc(const DiscCells& cells, DiscSums& sums) {
  HWY_DYNAMIC_DISPATCH(sumAllOfDisc)(cells, sums);
}

void sumSmearedDisc(const DiscCells& cells, DiscSums& sums) {
  HWY_DYNAMIC_DISPATCH(sumAllOfSmearedDisc)(cells, sums);
}

void sumCutDisc(const DiscCells& cells, DiscSums& sums) {
  HWY_DYNAMIC_DISPATCH(sumAllOfCutDisc)(cells, sums);
}

}  // namespace helical
#endif
