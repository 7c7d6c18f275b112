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

#include "engine/markers/disc_shading.inc"
#include "engine/markers/disc_sums.inc"

/// What a cell shows over what the model says.
HWY_INLINE Floats storeResidual(std::size_t i, Floats expected, Floats cover, DiscCells& cells) {
  const Tag d;
  const Floats residual = hn::Load(d, &cells.value[i]) - expected;
  hn::Store(cover, d, &cells.cover[i]);
  hn::Store(residual, d, &cells.residual[i]);
  return residual;
}

void measureAll(const DiscValues& p, DiscCells& cells, DiscSums& totals) {
  const Tag d;
  const DiscTerms disc(p);
  Sums<kDiscParameters> sums;
  for (std::size_t i = 0; i < cells.count; i += hn::Lanes(d)) {
    const Floats dx = hn::Load(d, &cells.x[i]) - disc.x, dy = hn::Load(d, &cells.y[i]) - disc.y,
                 given = hn::Load(d, &cells.given[i]);
    if (isOutside(disc, dx, dy)) {
      sums.addAround(i, storeResidual(i, disc.around, all(0.0F), cells), given);
      continue;
    }
    const ShadedCell cell = shaded(litCell(disc, dx, dy), disc.around);
    const Floats residual = storeResidual(i, disc.around + cell.above, cell.slope[kDiscAmbient], cells);
    sums.add(i, cell.slope, residual, given);
  }
  sums.store(totals);
}

void measureBoth(const DiscValues& p, const SecondPicture& picture, DiscCells& first, DiscCells& second,
                 DiscSums& first_totals, DiscSums& second_totals) {
  const Tag d;
  const DiscTerms disc(p);
  const Floats ratio = all(picture.ratio), around = all(picture.around);
  Sums<kDiscParameters> sums;
  Sums<kSecondParameters> second_sums;
  for (std::size_t i = 0; i < first.count; i += hn::Lanes(d)) {
    const Floats dx = hn::Load(d, &first.x[i]) - disc.x, dy = hn::Load(d, &first.y[i]) - disc.y,
                 given = hn::Load(d, &first.given[i]), second_given = hn::Load(d, &second.given[i]);
    if (isOutside(disc, dx, dy)) {
      sums.addAround(i, storeResidual(i, disc.around, all(0.0F), first), given);
      second_sums.addAround(i, storeResidual(i, around, all(0.0F), second), second_given);
      continue;
    }
    LitCell lit = litCell(disc, dx, dy);
    const ShadedCell cell = shaded(lit, disc.around);
    sums.add(i, cell.slope, storeResidual(i, disc.around + cell.above, lit.cover, first), given);
    const Floats by_ratio = lit.cover * lit.light;
    for (Floats* light : {&lit.light, &lit.turned_x, &lit.turned_y, &lit.grown, &lit.by_light_x,
                          &lit.by_light_y, &lit.by_light_z})
      *light = *light * ratio;
    const ShadedCell other = shaded(lit, around);
    const Floats(&by)[kDiscParameters] = other.slope;
    const Floats slope[kSecondParameters] = {by[0], by[1], by[2], ratio * by[3], by[4],
                                             by[5], by[6], by[7], by_ratio};
    second_sums.add(i, slope, storeResidual(i, around + other.above, lit.cover, second), second_given);
  }
  sums.store(first_totals);
  second_sums.store(second_totals);
}

constexpr float kSpreadStep = 0.5F;  ///< cells

/// Second derivatives by the disc's place, of the cells around its outline.
HWY_INLINE void spreadSlopes(const DiscTerms& disc, Floats dx, Floats dy, Floats* slope) {
  const Floats apart = all(kSpreadStep), over_twice = all(0.5F * 0.5F / kSpreadStep);
  const auto at = [&](Floats x, Floats y) HWY_ATTR { return shaded(litCell(disc, x, y), disc.around); };
  const ShadedCell right = at(dx - apart, dy), left = at(dx + apart, dy), below = at(dx, dy - apart),
                   above = at(dx, dy + apart);
  const Floats inner = positive(disc.inside - apart);
  const auto is_rim = hn::Ge(dx * dx + dy * dy, inner * inner);
  const auto slopeOf = [&](Floats more, Floats less)
                           HWY_ATTR { return hn::IfThenElseZero(is_rim, over_twice * (more - less)); };
  slope[kSpreadXX] = slopeOf(right.slope[kDiscX], left.slope[kDiscX]);
  slope[kSpreadXY] = all(2.0F) * slopeOf(right.slope[kDiscY], left.slope[kDiscY]);
  slope[kSpreadYY] = slopeOf(below.slope[kDiscY], above.slope[kDiscY]);
}

void measureSpread(const DiscValues& p, DiscCells& cells, DiscSums& totals) {
  const Tag d;
  const DiscTerms disc(p);
  const Floats zero = all(0.0F), inner = positive(disc.inside - all(kSpreadStep)), inside = inner * inner;
  const float outer = p[kDiscRadius] + kReach + kSpreadStep;
  const Floats outside = all(outer * outer);
  Sums<kSpreadParameters> sums;
  for (std::size_t i = 0; i < cells.count; i += hn::Lanes(d)) {
    const Floats dx = hn::Load(d, &cells.x[i]) - disc.x, dy = hn::Load(d, &cells.y[i]) - disc.y,
                 given = hn::Load(d, &cells.given[i]), d2 = dx * dx + dy * dy;
    if (hn::AllTrue(d, hn::Gt(d2, outside))) {
      sums.addAround(i, storeResidual(i, disc.around, zero, cells), given);
      continue;
    }
    const ShadedCell cell = shaded(litCell(disc, dx, dy), disc.around);
    Floats slope[kSpreadParameters] = {cell.slope[0], cell.slope[1], cell.slope[2], cell.slope[3],
                                       cell.slope[4], cell.slope[5], cell.slope[6], cell.slope[7],
                                       zero,          zero,          zero};
    if (!hn::AllTrue(d, hn::Lt(d2, inside))) spreadSlopes(disc, dx, dy, slope);
    sums.add(i, slope, storeResidual(i, disc.around + cell.above, cell.slope[kDiscAmbient], cells), given);
  }
  sums.store(totals);
}

void measureSmeared(const DiscValues& p, const DiscMotion& motion, DiscCells& cells, DiscSums& totals) {
  const Tag d;
  const DiscTerms disc(p);
  const Floats zero = all(0.0F), share = all(1.0F / static_cast<float>(motion.moments));
  Sums<kSmearParameters> sums;
  for (std::size_t i = 0; i < cells.count; i += hn::Lanes(d)) {
    const Floats dx = hn::Load(d, &cells.x[i]) - disc.x, dy = hn::Load(d, &cells.y[i]) - disc.y;
    Floats slope[kSmearParameters] = {zero, zero, zero, zero, zero, zero, zero, zero, zero, zero},
           above = zero;
    for (int k = 0; k < motion.moments; ++k) {
      const float at = (2.0F * static_cast<float>(k) + 1.0F) / static_cast<float>(motion.moments) - 1.0F;
      const Floats x = dx - all(at * motion.half_x), y = dy - all(at * motion.half_y);
      if (isOutside(disc, x, y)) continue;
      const ShadedCell cell = shaded(litCell(disc, x, y), disc.around);
      above = above + share * cell.above;
      for (int a = 0; a < kDiscAround; ++a) slope[a] = slope[a] + share * cell.slope[a];
      slope[kSmearHalfX] = slope[kSmearHalfX] + all(at) * share * cell.slope[kDiscX];
      slope[kSmearHalfY] = slope[kSmearHalfY] + all(at) * share * cell.slope[kDiscY];
    }
    const Floats cover = slope[kDiscAmbient];
    slope[kDiscAround] = all(1.0F) - cover;
    sums.add(i, slope, storeResidual(i, disc.around + above, cover, cells), hn::Load(d, &cells.given[i]));
  }
  sums.store(totals);
}

void measureCut(const DiscValues& p, const CutEdge& edge, DiscCells& cells, DiscSums& totals) {
  const Tag d;
  const DiscTerms disc(p);
  const Floats nx = all(edge.normal_x), ny = all(edge.normal_y), level = all(edge.level), one = all(1.0F);
  Sums<kCutParameters> sums;
  for (std::size_t i = 0; i < cells.count; i += hn::Lanes(d)) {
    const Floats x = hn::Load(d, &cells.x[i]), y = hn::Load(d, &cells.y[i]);
    const Floats disc_x = x - disc.x, disc_y = y - disc.y;
    const ShadedCell cell =
        isOutside(disc, disc_x, disc_y) ? nothingOf() : shaded(litCell(disc, disc_x, disc_y), disc.around);
    const Floats dx = x - all(edge.x), dy = y - all(edge.y);
    const CoveredPart part = coveredPart(all(edge.offset) - (nx * dx + ny * dy), hn::Abs(nx), hn::Abs(ny));
    const Floats seen = part.share;
    const Floats above = disc.around + cell.above - level;  // the disc over what hides it
    const Floats by_offset = part.slope * above;
    Floats slope[kCutParameters];
    for (int a = 0; a < kDiscParameters; ++a) slope[a] = seen * cell.slope[a];
    slope[kCutOffset] = by_offset;
    slope[kCutTurn] = by_offset * (ny * dx - nx * dy);
    slope[kCutLevel] = one - seen;
    sums.add(i, slope, storeResidual(i, level + seen * above, slope[kDiscAmbient], cells),
             hn::Load(d, &cells.given[i]));
  }
  sums.store(totals);
}

}  // namespace HWY_NAMESPACE
}  // namespace helical
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace helical {

HWY_EXPORT(measureAll);
HWY_EXPORT(measureBoth);
HWY_EXPORT(measureCut);
HWY_EXPORT(measureSmeared);
HWY_EXPORT(measureSpread);

void measureDisc(const DiscValues& disc, DiscCells& cells, DiscSums& sums) {
  HWY_DYNAMIC_DISPATCH(measureAll)(disc, cells, sums);
}

void measureTwo(const DiscValues& disc, const SecondPicture& picture, DiscCells& first, DiscCells& second,
                DiscSums& first_sums, DiscSums& second_sums) {
  HWY_DYNAMIC_DISPATCH(measureBoth)(disc, picture, first, second, first_sums, second_sums);
}

void measureCutDisc(const DiscValues& disc, const CutEdge& edge, DiscCells& cells, DiscSums& sums) {
  HWY_DYNAMIC_DISPATCH(measureCut)(disc, edge, cells, sums);
}

void measureSpreadDisc(const DiscValues& disc, DiscCells& cells, DiscSums& sums) {
  HWY_DYNAMIC_DISPATCH(measureSpread)(disc, cells, sums);
}

void measureSmearedDisc(const DiscValues& disc, const DiscMotion& motion, DiscCells& cells, DiscSums& sums) {
  HWY_DYNAMIC_DISPATCH(measureSmeared)(disc, motion, cells, sums);
}

}  // namespace helical
#endif
