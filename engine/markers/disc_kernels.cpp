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

/// The model's parameters and what follows from them, for all cells.
struct DiscTerms {
  explicit DiscTerms(const std::array<float, kDiscParameters>& p, bool shadowed)
      : x(all(p[kDiscX])),
        y(all(p[kDiscY])),
        radius(all(p[kDiscRadius])),
        inverse_radius(all(1.0F) / radius),
        ambient(all(p[kDiscAmbient])),
        light_x(all(p[kDiscLightX])),
        light_y(all(p[kDiscLightY])),
        light_z(all(p[kDiscLightZ])),
        around(all(p[kDiscAround])),
        with_shadow(shadowed) {}

  Floats x, y, radius, inverse_radius, ambient, light_x, light_y, light_z, around;
  bool with_shadow;
};

/// What the ball makes of a cell.
struct ShadedCell {
  Floats cover;                                                      ///< share of the cell
  Floats above;                                                      ///< what it adds to the level around it
  Floats by_x, by_y, by_radius, by_light_x, by_light_y, by_light_z;  ///< slopes; that by ambient is cover
};

/// `dx`, `dy`: from the ball's centre to the cell's.
HWY_INLINE ShadedCell shadedCell(const DiscTerms& disc, Floats dx, Floats dy) {
  const Floats zero = all(0.0F), half = all(0.5F);
  const Floats distance = hn::Sqrt(dx * dx + dy * dy) + all(1e-6F);
  const Floats nx = dx / distance, ny = dy / distance;
  const CoveredPart part = coveredPart(disc.radius - distance, hn::Abs(nx), hn::Abs(ny));
  const Floats cover = part.share, edge = part.slope;
  // Light is taken at two places of the part of the cell that the ball covers, along the radius.
  const Floats rho = (distance + part.middle) * disc.inverse_radius,
               spread = part.spread * disc.inverse_radius;
  const Floats z = half * (heightOnSphere(rho - spread) + heightOnSphere(rho + spread));
  const Floats u = nx * rho, v = ny * rho;
  Floats directed = disc.light_x * u + disc.light_y * v + disc.light_z * z;
  const Floats lit = disc.with_shadow ? hn::IfThenElse(hn::Gt(directed, zero), all(1.0F), zero) : all(1.0F);
  directed = directed * lit;
  const Floats contrast = disc.ambient + directed - disc.around;
  const Floats edge_contrast = edge * contrast, lit_cover = lit * cover;
  const Floats steep = disc.light_z / hn::Max(z, all(0.25F)), inward = lit_cover * disc.inverse_radius;
  const Floats by_u = disc.light_x - steep * u, by_v = disc.light_y - steep * v;
  ShadedCell cell;
  cell.cover = cover;
  cell.above = cover * contrast;
  cell.by_x = edge_contrast * nx - inward * by_u;
  cell.by_y = edge_contrast * ny - inward * by_v;
  cell.by_radius = edge_contrast - inward * (u * by_u + v * by_v);
  cell.by_light_x = lit_cover * u;
  cell.by_light_y = lit_cover * v;
  cell.by_light_z = lit_cover * z;
  return cell;
}

/// Sets a cell's residual, cover and slopes.
HWY_INLINE void storeCell(const DiscTerms& disc, const ShadedCell& cell, std::size_t i, DiscCells& cells) {
  const Tag d;
  hn::Store(cell.by_x, d, &cells.slope[kDiscX][i]);
  hn::Store(cell.by_y, d, &cells.slope[kDiscY][i]);
  hn::Store(cell.by_radius, d, &cells.slope[kDiscRadius][i]);
  hn::Store(cell.cover, d, &cells.slope[kDiscAmbient][i]);
  hn::Store(cell.by_light_x, d, &cells.slope[kDiscLightX][i]);
  hn::Store(cell.by_light_y, d, &cells.slope[kDiscLightY][i]);
  hn::Store(cell.by_light_z, d, &cells.slope[kDiscLightZ][i]);
  hn::Store(all(1.0F) - cell.cover, d, &cells.slope[kDiscAround][i]);
  hn::Store(cell.cover, d, &cells.cover[i]);
  hn::Store(hn::Load(d, &cells.value[i]) - (disc.around + cell.above), d, &cells.residual[i]);
}

void evaluateAll(const std::array<float, kDiscParameters>& p, bool with_shadow, DiscCells& cells) {
  const Tag d;
  const DiscTerms disc(p, with_shadow);
  for (std::size_t i = 0; i < cells.count; i += hn::Lanes(d))
    storeCell(disc, shadedCell(disc, hn::Load(d, &cells.x[i]) - disc.x, hn::Load(d, &cells.y[i]) - disc.y), i,
              cells);
}

void smearAll(const std::array<float, kDiscParameters>& p, bool with_shadow, const DiscMotion& motion,
              DiscCells& cells) {
  const Tag d;
  const DiscTerms disc(p, with_shadow);
  const Floats zero = all(0.0F), share = all(1.0F / static_cast<float>(motion.moments));
  const Floats reach = disc.radius + all(0.75F), reach2 = reach * reach;  // beyond half a cell's diagonal
  for (std::size_t i = 0; i < cells.count; i += hn::Lanes(d)) {
    const Floats dx = hn::Load(d, &cells.x[i]) - disc.x, dy = hn::Load(d, &cells.y[i]) - disc.y;
    ShadedCell sum{zero, zero, zero, zero, zero, zero, zero, zero};
    Floats by_half_x = zero, by_half_y = zero;
    for (int k = 0; k < motion.moments; ++k) {
      const float at = (2.0F * static_cast<float>(k) + 1.0F) / static_cast<float>(motion.moments) - 1.0F;
      const Floats x = dx - all(at * motion.half_x), y = dy - all(at * motion.half_y);
      if (hn::AllTrue(d, hn::Gt(x * x + y * y, reach2))) continue;
      const ShadedCell cell = shadedCell(disc, x, y);
      sum.cover = sum.cover + share * cell.cover;
      sum.above = sum.above + share * cell.above;
      sum.by_x = sum.by_x + share * cell.by_x;
      sum.by_y = sum.by_y + share * cell.by_y;
      sum.by_radius = sum.by_radius + share * cell.by_radius;
      sum.by_light_x = sum.by_light_x + share * cell.by_light_x;
      sum.by_light_y = sum.by_light_y + share * cell.by_light_y;
      sum.by_light_z = sum.by_light_z + share * cell.by_light_z;
      by_half_x = by_half_x + all(at) * share * cell.by_x;
      by_half_y = by_half_y + all(at) * share * cell.by_y;
    }
    storeCell(disc, sum, i, cells);
    hn::Store(by_half_x, d, &cells.slope[kSmearHalfX][i]);
    hn::Store(by_half_y, d, &cells.slope[kSmearHalfY][i]);
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

}  // namespace HWY_NAMESPACE
}  // namespace helical
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace helical {

HWY_EXPORT(evaluateAll);
HWY_EXPORT(cutAll);
HWY_EXPORT(smearAll);

void evaluateDisc(const std::array<float, kDiscParameters>& parameters, bool with_shadow, DiscCells& cells) {
  HWY_DYNAMIC_DISPATCH(evaluateAll)(parameters, with_shadow, cells);
}

void cutDisc(const CutEdge& edge, DiscCells& cells) {
  HWY_DYNAMIC_DISPATCH(cutAll)(edge, cells);
}

void smearDisc(const std::array<float, kDiscParameters>& parameters, bool with_shadow,
               const DiscMotion& motion, DiscCells& cells) {
  HWY_DYNAMIC_DISPATCH(smearAll)(parameters, with_shadow, motion, cells);
}

}  // namespace helical
#endif
