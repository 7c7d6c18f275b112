#include "engine/markers/disc_kernels.h"

#include <algorithm>

// clang-format off: foreach_target.h includes this file once per instruction set.
#define HWY_WANT_AVX3_DL
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/markers/disc_kernels.cpp"
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

HWY_INLINE Floats positive(Floats x) {
  return hn::Max(x, all(0.0F));
}

/// The part of a unit cell that lies inside of a straight edge.
struct CoveredPart {
  Floats share;   ///< of the cell
  Floats slope;   ///< of the share, by the edge's place
  Floats middle;  ///< of the part, from the cell's centre along the edge's outward normal
  Floats spread;  ///< standard deviation around it
};

/// `s` from the cell's centre to the edge along its outward normal, of which p and q are the absolute
/// components. Across the normal the cell is a trapezoid: what of it lies beyond |s| has the moments below.
HWY_INLINE CoveredPart coveredPart(Floats s, Floats p, Floats q) {
  const Floats longer = hn::Max(hn::Max(p, q), all(0.5F)), shorter = hn::Min(p, q);
  const Floats outer = all(0.5F) * (p + q), inner = all(0.5F) * (longer - shorter);
  const Floats distance = hn::Abs(s), rest = positive(outer - distance), in_slope = hn::Min(rest, shorter);
  const Floats middle =
      positive(inner - distance);  // of the part beyond, how far it reaches into the flat top
  // The sloping end, from `outer` inwards; it has the area in_slope^2 / (2 shorter longer).
  const Floats height =
      hn::IfThenElse(hn::Lt(distance, inner), all(1.0F), in_slope / hn::Max(shorter, all(1e-6F)));
  const Floats end = all(0.5F) * in_slope * height;
  const Floats end_moment = end * (outer - all(2.0F / 3.0F) * in_slope);
  const Floats end_square =
      end * (outer * (outer - all(4.0F / 3.0F) * in_slope) + all(0.5F) * in_slope * in_slope);
  const Floats flat_place = distance + all(0.5F) * middle;
  const Floats beyond = (end + middle) / longer;
  const Floats moment = (end_moment + middle * flat_place) / longer;
  const Floats square =
      (end_square + middle * (flat_place * flat_place + all(1.0F / 12.0F) * middle * middle)) / longer;
  const auto is_most = hn::Gt(s, all(0.0F));
  CoveredPart part;
  part.share = hn::IfThenElse(is_most, all(1.0F) - beyond, beyond);
  part.slope = height / longer;
  const Floats share = hn::Max(part.share, all(1e-6F));
  part.middle = all(0.0F) - moment / share;  // the whole cell's moment is 0
  const Floats mean_square = hn::IfThenElse(is_most, all(1.0F / 12.0F) - square, square) / share;
  part.spread = hn::Sqrt(positive(mean_square - part.middle * part.middle));
  return part;
}

HWY_INLINE Floats heightOnSphere(Floats rho) {
  return hn::Sqrt(positive(all(1.0F) - rho * rho));
}

void evaluateAll(const std::array<float, kDiscParameters>& p, bool with_shadow, DiscCells& cells) {
  const Tag d;
  const Floats radius = all(p[kDiscRadius]), inverse_radius = all(1.0F) / radius,
               around = all(p[kDiscAround]);
  const Floats light_x = all(p[kDiscLightX]), light_y = all(p[kDiscLightY]), light_z = all(p[kDiscLightZ]);
  const Floats zero = all(0.0F), half = all(0.5F);
  for (std::size_t i = 0; i < cells.count; i += hn::Lanes(d)) {
    const Floats dx = hn::Load(d, &cells.x[i]) - all(p[kDiscX]),
                 dy = hn::Load(d, &cells.y[i]) - all(p[kDiscY]);
    const Floats distance = hn::Sqrt(dx * dx + dy * dy) + all(1e-6F);
    const Floats nx = dx / distance, ny = dy / distance;
    const CoveredPart part = coveredPart(radius - distance, hn::Abs(nx), hn::Abs(ny));
    const Floats cover = part.share, edge = part.slope;
    // Light is taken at two places of the part of the cell that the ball covers, along the radius.
    const Floats rho = (distance + part.middle) * inverse_radius, spread = part.spread * inverse_radius;
    const Floats z = half * (heightOnSphere(rho - spread) + heightOnSphere(rho + spread));
    const Floats u = nx * rho, v = ny * rho;
    Floats directed = light_x * u + light_y * v + light_z * z;
    const Floats lit = with_shadow ? hn::IfThenElse(hn::Gt(directed, zero), all(1.0F), zero) : all(1.0F);
    directed = directed * lit;
    const Floats contrast = all(p[kDiscAmbient]) + directed - around;
    const Floats edge_contrast = edge * contrast, lit_cover = lit * cover;
    const Floats steep = light_z / hn::Max(z, all(0.25F)), inward = lit_cover * inverse_radius;
    const Floats by_u = light_x - steep * u, by_v = light_y - steep * v;
    const auto store = [&](DiscParameter parameter, Floats value)
                           HWY_ATTR { hn::Store(value, d, &cells.slope[parameter][i]); };
    store(kDiscX, edge_contrast * nx - inward * by_u);
    store(kDiscY, edge_contrast * ny - inward * by_v);
    store(kDiscRadius, edge_contrast - inward * (u * by_u + v * by_v));
    store(kDiscAmbient, cover);
    store(kDiscLightX, lit_cover * u);
    store(kDiscLightY, lit_cover * v);
    store(kDiscLightZ, lit_cover * z);
    store(kDiscAround, all(1.0F) - cover);
    hn::Store(cover, d, &cells.cover[i]);
    hn::Store(hn::Load(d, &cells.value[i]) - (around + cover * contrast), d, &cells.residual[i]);
  }
}

void cutAll(const CutEdge& edge, DiscCells& cells) {
  const Tag d;
  const Floats nx = all(edge.normal_x), ny = all(edge.normal_y), level = all(edge.level), one = all(1.0F);
  for (std::size_t i = 0; i < cells.count; i += hn::Lanes(d)) {
    const Floats dx = hn::Load(d, &cells.x[i]) - all(edge.x), dy = hn::Load(d, &cells.y[i]) - all(edge.y);
    const CoveredPart part = coveredPart(all(edge.offset) - (nx * dx + ny * dy), hn::Abs(nx), hn::Abs(ny));
    const Floats seen = part.share, value = hn::Load(d, &cells.value[i]);
    const Floats above = value - hn::Load(d, &cells.residual[i]) - level;  // the disc over what hides it
    for (int k = 0; k < kDiscParameters; ++k)
      hn::Store(seen * hn::Load(d, &cells.slope[k][i]), d, &cells.slope[k][i]);
    const Floats by_offset = part.slope * above;
    hn::Store(by_offset, d, &cells.slope[kCutOffset][i]);
    hn::Store(by_offset * (ny * dx - nx * dy), d, &cells.slope[kCutTurn][i]);
    hn::Store(one - seen, d, &cells.slope[kCutLevel][i]);
    hn::Store(seen * hn::Load(d, &cells.cover[i]), d, &cells.cover[i]);
    hn::Store(value - (level + seen * above), d, &cells.residual[i]);
  }
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

void sumAllOfCutDisc(const DiscCells& cells, DiscSums& sums) {
  sumAll<kCutParameters>(cells, sums);
}

}  // namespace HWY_NAMESPACE
}  // namespace helical
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace helical {

HWY_EXPORT(evaluateAll);
HWY_EXPORT(cutAll);
HWY_EXPORT(sumAllOfDisc);
HWY_EXPORT(sumAllOfCutDisc);

void evaluateDisc(const std::array<float, kDiscParameters>& parameters, bool with_shadow, DiscCells& cells) {
  HWY_DYNAMIC_DISPATCH(evaluateAll)(parameters, with_shadow, cells);
}

void cutDisc(const CutEdge& edge, DiscCells& cells) {
  HWY_DYNAMIC_DISPATCH(cutAll)(edge, cells);
}

void sumDisc(const DiscCells& cells, DiscSums& sums) {
  HWY_DYNAMIC_DISPATCH(sumAllOfDisc)(cells, sums);
}

void sumCutDisc(const DiscCells& cells, DiscSums& sums) {
  HWY_DYNAMIC_DISPATCH(sumAllOfCutDisc)(cells, sums);
}

}  // namespace helical
#endif
