#include "engine/markers/disc_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/geometry/rotation.h"
#include "engine/markers/cell_scatter.h"
#include "engine/markers/cut_disc.h"
#include "engine/markers/disc_normal.h"

namespace helical {
namespace {

constexpr double kLeastContrast = 8.0;
constexpr int kSteps = 6;
constexpr int kRounds = 3;
/// Share of the contrast that residuals may have beyond noise: a ball with a pattern or smeared by its motion
/// is no shaded disc, and its centre of gravity is the steadier estimate.
constexpr double kWorstMisfit = 0.12;
/// Cells. Of a ball so large the region's centre of gravity is good, and what the model lacks (prints, hands,
/// blur: measured on a real ball of 28 pixels) does more harm than noise: the disc must be close to the
/// region.
constexpr double kLarge = 12.0;
constexpr double kLargeSeen = 0.97;
constexpr double kLargeApart = 0.065;   ///< of the radius
constexpr double kOutlineSigma = 0.15;  ///< cells, per axis: of a circle through an outline
/// Of a disc with an edge before it: the same with room for the few cells that the noise is known by, and
/// the share that must be seen. What is no such disc leaves ten times as much.
constexpr double kCutTail = 3.0, kLeastSeen = 0.3;
/// Elongation: from the first on, what is no disc may be smeared; from the second on, it is not asked whether
/// it is a disc, which noise makes longish by no more.
constexpr double kLeastSmear = 1.07, kSurelySmeared = 1.25;
constexpr double kMaybeMoved = 4.5;  ///< chi-square that a motion should gain
/// Of what a disc at rest leaves beyond noise, the share that a motion should explain, by the score test: of
/// hidden balls it is up to 0.03, of small ones before noise rarely over 0.1; of smeared ones it is over 0.1,
/// rarely under 0.07. What is alike on both sides is no hidden ball as often.
constexpr double kMaybeMotion = 0.04, kLeastMotion = 0.02;
constexpr double kSurelyCut = 0.3;   ///< excess a cell: of what is hidden and one-sided, no motion is tried
constexpr double kSurelyLong = 2.8;  ///< elongation: nothing hides so much of a ball that is still found
constexpr double kAny = std::numeric_limits<double>::infinity();
constexpr double kSurelyOne = 1.4;    ///< misfit of a smeared ball that is no pair
constexpr double kSurelyMoved = 9.0;  ///< chi-square over a ball at rest
/// Cells of a region: fewer say too little of which of its sides are alike.
constexpr std::int64_t kFewestSmeared = 40;

constexpr double kDisagreement = 16.0;  ///< chi-square between colour and both

Disc discOf(const SmearedBall& ball) {
  Disc disc;
  disc.centre = ball.centre;
  disc.half_way = ball.half;
  disc.covariance = ball.covariance;
  disc.radius = ball.radius;
  disc.seen_share = std::clamp(ball.seen / (kPi * disc.radius * disc.radius), 0.0, 1.0);
  return disc;
}

}  // namespace

std::optional<Disc> DiscFit::fit(const CellGrid& grid, const Region& region) {
  smear_.setZero();
  return window_.read(grid, region) ? fitWindow(grid) : std::nullopt;
}

std::optional<Disc> DiscFit::fitWindow(const CellGrid& grid) {
  const auto by_colour = fitColour(grid);
  if (!by_colour || !window_.has_colour || !by_colour->half_way.isZero()) return by_colour;
  return withBrightness(*by_colour);
}

std::optional<std::array<Disc, 2>> DiscFit::fitTwo(const CellGrid& grid, const Region& region) {
  if (!OverlapSplit::mayBeTwo(region) || !window_.read(grid, region)) return std::nullopt;
  const ValueWindow values = window_.values();
  auto pair = split_.circles(values);
  if (!pair || isOneMoving(grid)) return std::nullopt;
  std::array<Region, 2> parts{OverlapSplit::partOf(values, (*pair)[0], (*pair)[1]),
                              OverlapSplit::partOf(values, (*pair)[1], (*pair)[0])};
  for (std::size_t i = 0; i < 2; ++i) {
    Region& part = parts[i];
    part.sum_x += part.area * window_.left;
    part.sum_y += part.area * window_.top;
    part.left += window_.left, part.right += window_.left, part.top += window_.top,
        part.bottom += window_.top;
    (*pair)[i].centre.x += window_.left;
    (*pair)[i].centre.y += window_.top;
  }
  return std::array<Disc, 2>{fitPart(grid, parts[0], (*pair)[0], (*pair)[1]),
                             fitPart(grid, parts[1], (*pair)[1], (*pair)[0])};
}

bool DiscFit::isOneMoving(const CellGrid& grid) {
  const auto ball = fitMoving(grid, smearOfRegion(), nullptr, kAny);
  return ball && ball->misfit < kSurelyOne;
}

Disc DiscFit::fitPart(const CellGrid& grid, Region part, const OutlineCircle& mine,
                      const OutlineCircle& other) {
  window_.neighbour = other;
  std::optional<Disc> disc;
  if (window_.read(grid, part)) {
    window_.binary = {{mine.centre.x - window_.left, mine.centre.y - window_.top}, mine.radius};
    disc = fitWindow(grid);
  }
  window_.neighbour.reset();
  if (disc) return *disc;
  Disc outline;
  outline.centre = {mine.centre.x, mine.centre.y};
  outline.covariance = kOutlineSigma * kOutlineSigma * Eigen::Matrix2d::Identity();
  outline.radius = mine.radius;
  outline.seen_share = std::min(1.0, static_cast<double>(part.area) / (kPi * mine.radius * mine.radius));
  return outline;
}

Smear DiscFit::smearOfRegion() const {
  if (window_.neighbour) return {};
  const ValueWindow values = window_.values();
  return measureSmear({{window_.colour->x.data(), window_.real_count},
                       {window_.colour->y.data(), window_.real_count},
                       {window_.colour->value.data(), window_.real_count},
                       static_cast<double>(values.level),
                       static_cast<double>(values.contrast)});
}

std::optional<SmearedBall> DiscFit::fitMoving(const CellGrid& grid, const Smear& smear,
                                              const DiscValues* at_rest, double most_excess) {
  if (!(smear.shorter > 0.0)) return std::nullopt;
  const ValueWindow values = window_.values();
  SmearStart start;
  start.middle = smear.middle + window_.corner();
  start.half = std::sqrt(3.0 * (smear.longer - smear.shorter)) * smear.axis;
  start.radius = 2.0 * std::sqrt(smear.shorter);
  start.ball = static_cast<double>(values.level + values.contrast);
  start.around = static_cast<double>(values.level - values.contrast);
  DiscValues disc{};
  if (at_rest != nullptr) {
    disc = *at_rest;
    disc[kDiscX] += static_cast<float>(window_.left);
    disc[kDiscY] += static_cast<float>(window_.top);
  }
  const auto ball =
      smear_fit_.fit(grid, window_.axis, start, at_rest != nullptr ? &disc : nullptr, most_excess);
  const bool is_ball = ball && ball->contrast > kLeastContrast && ball->misfit < kCutTail &&
                       ball->gain > kSurelyMoved && !isDoubtful(*ball, start, smear);
  return is_ball ? ball : std::nullopt;
}

std::optional<Disc> DiscFit::fitColour(const CellGrid& grid) {
  const Smear smear = smearOfRegion();
  const bool has_sides = window_.region.area >= kFewestSmeared;
  if (has_sides && smear.elongation > kLeastSmear) smear_ = smear.covariance;
  const bool is_smeared = has_sides && smear.isOver(kSurelySmeared);
  disc_.start(window_.binary);
  double motion = kAny;  // share of what is left at rest; not known
  if (!is_smeared && disc_.descend(kSteps) && isPlausible()) {
    const double gain = window_.neighbour ? 0.0 : disc_.gainOfMotion();
    motion = gain / std::max(kMaybeMoved / kMaybeMotion, disc_.excess());
    if (disc_.fitsEverywhere()) {
      if (gain > kMaybeMoved)
        if (const auto ball = fitMoving(grid, smear, &disc_.parameters(), kAny)) return discOf(*ball);
      if (const auto disc = result()) return disc;
    }
  }
  if (!window_.neighbour)
    if (const auto disc = fitMovingOrCut(grid, smear, motion)) return disc;
  if (has_sides && smear.isOver(kLeastSmear)) return std::nullopt;
  disc_.start(window_.neighbour ? window_.binary : outlineOfRest());
  for (int round = 0; round < kRounds; ++round) {
    if (!disc_.leaveOutHidden() && round > 0) break;
    if (!disc_.descend(kSteps) || !isPlausible()) return std::nullopt;
  }
  return result();
}

OutlineCircle DiscFit::outlineOfRest() const {
  std::array<OutlinePoint, kOutlineRays> room;
  const int count = window_.traceOutline(static_cast<double>(window_.values().level), room);
  return bestCircle({room.data(), static_cast<std::size_t>(count)}, window_.binary.radius)
      .value_or(window_.binary);
}

std::optional<Disc> DiscFit::fitMovingOrCut(const CellGrid& grid, const Smear& smear, double motion) {
  const bool is_smeared = window_.region.area >= kFewestSmeared && smear.isOver(kLeastSmear);
  const bool is_large = window_.binary.radius >= kLarge;
  const bool may_move = is_smeared || motion > (smear.one_sided ? kMaybeMotion : kLeastMotion);
  if (is_large && (!may_move || smear.one_sided)) return std::nullopt;
  // Of a large ball only one that is seen nearly whole is believed, which no edge hides a part of.
  std::optional<Disc> cut;
  double excess = kAny;
  if (!is_large && !is_smeared && smear.elongation < kSurelyLong) cut = fitCut(excess);
  const bool is_cut = !cut || excess < kSurelyCut * static_cast<double>(window_.real_count);
  if (!may_move && is_cut) return cut;
  const auto ball = fitMoving(grid, smear, nullptr, excess);
  return ball && ball->excess < excess ? discOf(*ball) : cut;
}

std::optional<Disc> DiscFit::fitCut(double& excess) {
  DiscCells& cells = *window_.colour;
  disc_.start(window_.binary);
  const auto [cut, covariance] = nearestCut(disc_.parameters(), cells);
  double seen = 0.0;
  for (std::size_t i = 0; i < window_.real_count; ++i) seen += cells.cover[i];
  const double noise = noiseAround(cells, window_.room), squares = cut.squares / (noise * noise);
  disc_.start(cut.disc);
  const auto disc = believed(covariance, seen);
  if (squares > kCutTail * cut.count || !isPlausible() || !disc || disc->seen_share < kLeastSeen)
    return std::nullopt;
  excess = squares - cut.count;
  disc_.leaveOutHidden();
  return disc;
}

std::optional<Disc> DiscFit::withBrightness(const Disc& by_colour) {
  if (!disc_.startBrightness() || !disc_.descend(kSteps) || !isPlausible()) return by_colour;
  const auto by_both = result();
  if (!by_both) return by_colour;
  const Eigen::Vector2d apart = by_both->centre - by_colour.centre;
  return apart.squaredNorm() < kDisagreement * by_colour.covariance.trace() ? *by_both : by_colour;
}

std::optional<Disc> DiscFit::result() {
  const ShadedDisc::Quality quality = disc_.quality();
  const double noise = disc_.noise(), misfit = kWorstMisfit * disc_.contrast();
  if (quality.variance > noise * noise + misfit * misfit) return std::nullopt;
  return believed(quality.covariance, disc_.seenCells());
}

std::optional<Disc> DiscFit::believed(const Eigen::Matrix2d& covariance, double seen) const {
  Disc disc;
  disc.centre = window_.corner() + disc_.centre();
  disc.covariance = covariance;
  disc.radius = disc_.radius();
  // What of the disc lies outside of the fitted cells is hidden, too.
  disc.seen_share = std::clamp(seen / (kPi * disc.radius * disc.radius), 0.0, 1.0);
  if (isDoubtful(disc)) return std::nullopt;
  const double trace = disc.covariance.trace();
  if (!(trace > 0.0 && trace < disc.radius * disc.radius)) return std::nullopt;
  return disc;
}

bool DiscFit::isDoubtful(const Disc& disc) const {
  const double radius = window_.binary.radius;
  if (radius < kLarge || window_.neighbour) return false;
  return disc.seen_share < kLargeSeen || std::abs(disc.radius - radius) > kLargeApart * radius ||
         squaredFromRegion() > kLargeApart * kLargeApart * radius * radius;
}

bool DiscFit::isDoubtful(const SmearedBall& ball, const SmearStart& start, const Smear& smear) const {
  if (window_.binary.radius < kLarge) return false;
  const double apart = kLargeApart * start.radius;
  return smear.one_sided || std::abs(ball.radius - start.radius) > apart ||
         (ball.centre - start.middle).squaredNorm() > apart * apart;
}

bool DiscFit::isPlausible() const {
  const double radius = disc_.radius(), binary = window_.binary.radius;
  return squaredFromRegion() < binary * binary && radius > 0.6 * binary && radius < 2.0 * binary &&
         disc_.contrast() > kLeastContrast;
}

double DiscFit::squaredFromRegion() const {
  const auto& [x, y] = window_.binary.centre;
  return (disc_.centre() - Eigen::Vector2d(x, y)).squaredNorm();
}

}  // namespace helical
