#include "engine/markers/disc_kernels.h"

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

/// The share of a unit cell that lies inside of a straight edge, `s` from the cell's centre to the edge along
/// the edge's outward normal, of which p and q are the absolute components; and its derivative by s.
HWY_INLINE Floats coverage(Floats s, Floats p, Floats q, Floats& slope) {
  const Floats outer = all(0.5F) * (p + q), inner = all(0.5F) * hn::Abs(p - q), longer = hn::Max(p, q);
  const Floats distance = hn::Abs(s), rest = positive(outer - distance);
  const Floats product = hn::Max(all(2.0F) * p * q, all(1e-12F));
  const Floats corner = rest * rest / product;
  const auto in_middle = hn::Le(distance, inner);
  const Floats on_slope = all(0.5F) + s / longer;
  const Floats at_end = hn::IfThenElse(hn::Gt(s, all(0.0F)), all(1.0F) - corner, corner);
  slope = hn::IfThenElse(in_middle, all(1.0F) / longer, all(2.0F) * rest / product);
  return hn::IfThenElse(in_middle, on_slope, at_end);
}

HWY_INLINE Floats heightOnSphere(Floats rho) {
  return hn::Sqrt(positive(all(1.0F) - rho * rho));
}

void evaluateAll(const std::array<float, kDiscParameters>& p, bool with_shadow, DiscCells& cells) {
  const Tag d;
  const Floats radius = all(p[kDiscRadius]), inverse_radius = all(1.0F) / radius,
               around = all(p[kDiscAround]);
  const Floats light_x = all(p[kDiscLightX]), light_y = all(p[kDiscLightY]), light_z = all(p[kDiscLightZ]);
  const Floats zero = all(0.0F), half_cell = all(0.5F);
  for (std::size_t i = 0; i < cells.count; i += hn::Lanes(d)) {
    const Floats dx = hn::Load(d, &cells.x[i]) - all(p[kDiscX]),
                 dy = hn::Load(d, &cells.y[i]) - all(p[kDiscY]);
    const Floats distance = hn::Sqrt(dx * dx + dy * dy) + all(1e-6F);
    const Floats nx = dx / distance, ny = dy / distance;
    Floats edge;
    const Floats cover = coverage(radius - distance, hn::Abs(nx), hn::Abs(ny), edge);
    // Light is taken at the middle of the part of the cell that the ball covers, along the radius.
    const Floats from = positive(distance - half_cell);
    const Floats to = hn::Max(from, hn::Min(distance + half_cell, radius));
    const Floats rho = half_cell * (from + to) * inverse_radius;
    const Floats spread = all(0.28867513F) * (to - from) * inverse_radius;
    const Floats z = half_cell * (heightOnSphere(rho - spread) + heightOnSphere(rho + spread));
    const auto at_centre = hn::Lt(distance, half_cell);
    const Floats u = hn::IfThenElse(at_centre, dx * inverse_radius, nx * rho);
    const Floats v = hn::IfThenElse(at_centre, dy * inverse_radius, ny * rho);
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

void weighAll(float limit, DiscCells& cells) {
  const Tag d;
  const Floats inverse = all(limit > 0.0F ? 1.0F / limit : 0.0F);
  for (std::size_t i = 0; i < cells.count; i += hn::Lanes(d)) {
    const Floats z = hn::Load(d, &cells.residual[i]) * inverse, keep = positive(all(1.0F) - z * z);
    hn::Store(keep * keep * hn::Load(d, &cells.given[i]), d, &cells.weight[i]);
  }
}

/// Sum of weight a b, always over kDiscLanes partial sums.
template <class A, class B>
HWY_INLINE double sumOver(const DiscCells& cells, A a, B b) {
  const Tag d;
  alignas(64) std::array<float, kDiscLanes> lanes;
  for (std::size_t k = 0; k < kDiscLanes; k += hn::Lanes(d)) {
    Floats sum = hn::Zero(d);
    for (std::size_t i = k; i < cells.count; i += kDiscLanes)
      sum = sum + hn::Load(d, &cells.weight[i]) * a(i) * b(i);
    hn::Store(sum, d, &lanes[k]);
  }
  double total = 0.0;
  for (const float lane : lanes) total += static_cast<double>(lane);
  return total;
}

void sumAll(const DiscCells& cells, DiscSums& sums) {
  const auto one = [](std::size_t) HWY_ATTR { return all(1.0F); };
  const auto residual = [&](std::size_t i) HWY_ATTR { return hn::Load(Tag(), &cells.residual[i]); };
  for (std::size_t a = 0; a < kDiscParameters; ++a) {
    const auto slope_a = [&](std::size_t i) HWY_ATTR { return hn::Load(Tag(), &cells.slope[a][i]); };
    for (std::size_t b = 0; b <= a; ++b) {
      const auto slope_b = [&](std::size_t i) HWY_ATTR { return hn::Load(Tag(), &cells.slope[b][i]); };
      sums.normal[a][b] = sumOver(cells, slope_a, slope_b);
    }
    sums.gradient[a] = sumOver(cells, slope_a, residual);
  }
  sums.weight = sumOver(cells, one, one);
  sums.squares = sumOver(cells, residual, residual);
}

}  // namespace HWY_NAMESPACE
}  // namespace helical
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace helical {

HWY_EXPORT(evaluateAll);
HWY_EXPORT(weighAll);
HWY_EXPORT(sumAll);

void evaluateDisc(const std::array<float, kDiscParameters>& parameters, bool with_shadow, DiscCells& cells) {
  HWY_DYNAMIC_DISPATCH(evaluateAll)(parameters, with_shadow, cells);
}

void weighDisc(float limit, DiscCells& cells) {
  HWY_DYNAMIC_DISPATCH(weighAll)(limit, cells);
}

void sumDisc(const DiscCells& cells, DiscSums& sums) {
  HWY_DYNAMIC_DISPATCH(sumAll)(cells, sums);
}

}  // namespace helical
#endif
