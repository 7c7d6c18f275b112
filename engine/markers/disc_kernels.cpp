#include "engine/markers/disc_kernels.h"

#include <algorithm>
#include <cmath>

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

/// Whether all of the cells that are summed beside each other from `i` on lie beyond that squared distance.
HWY_INLINE bool isBeyond(const DiscTerms& disc, Floats squared, const DiscCells& cells, std::size_t i) {
  const Tag d;
  for (std::size_t k = i; k < i + kDiscLanes; k += hn::Lanes(d)) {
    const Floats dx = hn::Load(d, &cells.x[k]) - disc.x, dy = hn::Load(d, &cells.y[k]) - disc.y;
    if (!hn::AllTrue(d, hn::Gt(dx * dx + dy * dy, squared))) return false;
  }
  return true;
}

/// Of cells that show nothing of the disc.
template <class SumsOfCells>
HWY_INLINE void addAround(Floats around, std::size_t i, DiscCells& cells, SumsOfCells& sums) {
  const Tag d;
  for (std::size_t lane = 0; lane < kDiscLanes; lane += hn::Lanes(d))
    sums.addAround(lane, storeResidual(i + lane, around, all(0.0F), cells),
                   hn::Load(d, &cells.given[i + lane]));
}

/// Gives `one` each vector of cells that may show something of the disc, by its first cell, the lane that
/// stands in its sums, and the way there from the disc's centre; and adds up all others.
template <class SumsOfCells, class One>
HWY_INLINE void forEachNear(const DiscTerms& disc, Floats squared, DiscCells& cells, SumsOfCells& sums,
                            One one) {
  const Tag d;
  for (std::size_t i = 0; i < cells.count; i += kDiscLanes) {
    if (isBeyond(disc, squared, cells, i)) {
      addAround(disc.around, i, cells, sums);
      continue;
    }
    for (std::size_t lane = 0; lane < kDiscLanes; lane += hn::Lanes(d))
      one(i + lane, lane, hn::Load(d, &cells.x[i + lane]) - disc.x, hn::Load(d, &cells.y[i + lane]) - disc.y);
    sums.next();
  }
}

void measureAll(const DiscValues& p, DiscCells& cells, DiscSums& totals) {
  const Tag d;
  const DiscTerms disc(p);
  Sums<kDiscParameters> sums;
  forEachNear(disc, disc.outside, cells, sums,
              [&](std::size_t i, std::size_t lane, Floats dx, Floats dy) HWY_ATTR {
                const ShadedCell cell = shaded(litCell(disc, dx, dy), disc.around);
                sums.add(lane, cell.slope,
                         storeResidual(i, disc.around + cell.above, cell.slope[kDiscAmbient], cells),
                         hn::Load(d, &cells.given[i]));
              });
  sums.store(totals);
}

void measureBoth(const DiscValues& p, const SecondPicture& picture, DiscCells& first, DiscCells& second,
                 DiscSums& first_totals, DiscSums& second_totals) {
  const Tag d;
  const DiscTerms disc(p);
  const Floats ratio = all(picture.ratio), around = all(picture.around);
  Sums<kDiscParameters> sums;
  Sums<kSecondParameters> second_sums;
  const auto addNear = [&](std::size_t i, std::size_t lane) HWY_ATTR {
    LitCell lit = litCell(disc, hn::Load(d, &first.x[i]) - disc.x, hn::Load(d, &first.y[i]) - disc.y);
    const ShadedCell cell = shaded(lit, disc.around);
    sums.add(lane, cell.slope, storeResidual(i, disc.around + cell.above, lit.cover, first),
             hn::Load(d, &first.given[i]));
    const Floats by_ratio = lit.cover * lit.light;
    for (Floats* light : {&lit.light, &lit.turned_x, &lit.turned_y, &lit.grown, &lit.by_light_x,
                          &lit.by_light_y, &lit.by_light_z})
      *light = *light * ratio;
    const ShadedCell other = shaded(lit, around);
    const Floats(&by)[kDiscParameters] = other.slope;
    const Floats slope[kSecondParameters] = {by[0], by[1], by[2], ratio * by[3], by[4],
                                             by[5], by[6], by[7], by_ratio};
    second_sums.add(lane, slope, storeResidual(i, around + other.above, lit.cover, second),
                    hn::Load(d, &second.given[i]));
  };
  for (std::size_t i = 0; i < first.count; i += kDiscLanes) {
    if (isBeyond(disc, disc.outside, first, i)) {
      addAround(disc.around, i, first, sums);
      addAround(around, i, second, second_sums);
      continue;
    }
    for (std::size_t lane = 0; lane < kDiscLanes; lane += hn::Lanes(d)) addNear(i + lane, lane);
    sums.next();
    second_sums.next();
  }
  sums.store(first_totals);
  second_sums.store(second_totals);
}

void measureSpread(const DiscValues& p, DiscCells& cells, DiscSums& totals) {
  const Tag d;
  const DiscTerms disc(p);
  const Floats zero = all(0.0F), inner = positive(disc.inside - all(kSpreadStep)), inside = inner * inner;
  const float outer = p[kDiscRadius] + kReach + kSpreadStep;
  Sums<kSpreadParameters> sums;
  forEachNear(disc, all(outer * outer), cells, sums,
              [&](std::size_t i, std::size_t lane, Floats dx, Floats dy) HWY_ATTR {
                const ShadedCell cell = shaded(litCell(disc, dx, dy), disc.around);
                const Floats(&by)[kDiscParameters] = cell.slope;
                Floats slope[kSpreadParameters] = {by[0], by[1], by[2], by[3], by[4], by[5],
                                                   by[6], by[7], zero,  zero,  zero};
                if (!hn::AllTrue(d, hn::Lt(dx * dx + dy * dy, inside))) spreadSlopes(disc, dx, dy, slope);
                sums.add(lane, slope,
                         storeResidual(i, disc.around + cell.above, cell.slope[kDiscAmbient], cells),
                         hn::Load(d, &cells.given[i]));
              });
  sums.store(totals);
}

void measureSmeared(const DiscValues& p, const DiscMotion& motion, DiscCells& cells, DiscSums& totals) {
  const Tag d;
  const DiscTerms disc(p);
  const Floats zero = all(0.0F), share = all(1.0F / static_cast<float>(motion.moments));
  const float half = std::sqrt(motion.half_x * motion.half_x + motion.half_y * motion.half_y);
  const float outer = p[kDiscRadius] + kReach + half;
  Sums<kSmearParameters> sums;
  forEachNear(disc, all(outer * outer), cells, sums,
              [&](std::size_t i, std::size_t lane, Floats dx, Floats dy) HWY_ATTR {
                Floats above = zero;
                Floats slope[kSmearParameters] = {zero, zero, zero, zero, zero, zero, zero, zero, zero, zero};
                for (int k = 0; k < motion.moments; ++k) {
                  const float at =
                      (2.0F * static_cast<float>(k) + 1.0F) / static_cast<float>(motion.moments) - 1.0F;
                  const Floats x = dx - all(at * motion.half_x), y = dy - all(at * motion.half_y);
                  if (hn::AllTrue(d, hn::Gt(x * x + y * y, disc.outside))) continue;
                  const ShadedCell cell = shaded(litCell(disc, x, y), disc.around);
                  above = above + share * cell.above;
                  for (int a = 0; a < kDiscAround; ++a) slope[a] = slope[a] + share * cell.slope[a];
                  slope[kSmearHalfX] = slope[kSmearHalfX] + all(at) * share * cell.slope[kDiscX];
                  slope[kSmearHalfY] = slope[kSmearHalfY] + all(at) * share * cell.slope[kDiscY];
                }
                const Floats cover = slope[kDiscAmbient];
                slope[kDiscAround] = all(1.0F) - cover;
                sums.add(lane, slope, storeResidual(i, disc.around + above, cover, cells),
                         hn::Load(d, &cells.given[i]));
              });
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
    const bool is_outside = hn::AllTrue(d, hn::Gt(disc_x * disc_x + disc_y * disc_y, disc.outside));
    const ShadedCell cell = is_outside ? nothingOf() : shaded(litCell(disc, disc_x, disc_y), disc.around);
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
    sums.add(i % kDiscLanes, slope, storeResidual(i, level + seen * above, slope[kDiscAmbient], cells),
             hn::Load(d, &cells.given[i]));
    if ((i + hn::Lanes(d)) % kDiscLanes == 0) sums.next();
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
