#include "engine/markers/smear_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/markers/cell_scatter.h"
#include "engine/markers/disc_descent.h"
#include "engine/markers/disc_normal.h"

namespace helical {
namespace {

constexpr double kReach = 3.0;      ///< cells around the way that are fitted, too
constexpr double kPaleEnds = 0.75;  ///< of the half way: as far its ends are too pale to be found
constexpr double kLeastHalf = 0.4;  ///< cells: with no way at all, no direction is better than another
constexpr int kFirstSteps = 4, kSteps = 10;
/// After the first steps: chi-square that a motion must have gained by then over a ball at rest, and what the
/// excess may still have to fall by, a cell.
constexpr double kSoonGained = 3.0, kStillToFall = 0.3;
constexpr double kShort = 0.25;                                ///< radii of a half way
constexpr double kMostHalf = 5.0;                              ///< radii
constexpr double kSmaller = 0.5, kLarger = 1.6, kApart = 1.0;  ///< radii at the start, and cells

double distanceToWay(double x, double y, const Eigen::Vector2d& half) {
  const double length2 = half.squaredNorm();
  const double at = length2 > 0.0 ? std::clamp((x * half.x() + y * half.y()) / length2, -1.0, 1.0) : 0.0;
  const double dx = x - at * half.x(), dy = y - at * half.y();
  return std::sqrt(dx * dx + dy * dy);
}

}  // namespace

SmearFit::SmearFit() : cells_(std::make_unique<DiscCells>()), room_(kDiscCells) {}

bool SmearFit::readAlong(const CellGrid& grid, const Eigen::Vector3d& axis, const SmearStart& start) {
  const double length = start.half.norm(), reach = start.radius + kReach;
  const double pale = kPaleEnds * std::min(length, start.radius);
  const Eigen::Vector2d half = length > 0.0 ? (1.0 + pale / length) * start.half : start.half;
  const double reach_x = std::abs(half.x()) + reach, reach_y = std::abs(half.y()) + reach;
  left_ = std::max(0, static_cast<int>(std::ceil(start.middle.x() - reach_x)));
  top_ = std::max(0, static_cast<int>(std::ceil(start.middle.y() - reach_y)));
  const int right = std::min(grid.width - 1, static_cast<int>(std::floor(start.middle.x() + reach_x)));
  const int bottom = std::min(grid.height - 1, static_cast<int>(std::floor(start.middle.y() + reach_y)));
  DiscCells& cells = *cells_;
  cells.count = 0;
  std::array<std::uint8_t, 3> cell{};
  for (int y = top_; y <= bottom; ++y)
    for (int x = left_; x <= right; ++x) {
      if (distanceToWay(x - start.middle.x(), y - start.middle.y(), half) > reach) continue;
      if (cells.count + kDiscLanes > kDiscCells) return false;
      readCell(grid, x, y, cell.data());
      const std::size_t i = cells.count++;
      cells.x[i] = static_cast<float>(x - left_);
      cells.y[i] = static_cast<float>(y - top_);
      cells.value[i] = static_cast<float>(axis[0] * cell[0] + axis[1] * cell[1] + axis[2] * cell[2]);
      cells.given[i] = 1.0F;
    }
  real_count_ = cells.count;
  for (; cells.count % kDiscLanes != 0; ++cells.count)
    cells.x[cells.count] = cells.y[cells.count] = cells.value[cells.count] = cells.given[cells.count] = 0.0F;
  return real_count_ > std::size_t{4} * kSmearParameters;
}

SmearedDisc SmearFit::startingFrom(const SmearStart& start) const {
  SmearedDisc disc;
  const double length = start.half.norm();
  const Eigen::Vector2d half =
      length > kLeastHalf ? start.half
                          : Eigen::Vector2d(length > 0.0 ? Eigen::Vector2d(kLeastHalf / length * start.half)
                                                         : Eigen::Vector2d(kLeastHalf, 0.0));
  // A way longer than the ball is nowhere covered for the whole time.
  const double covered = std::min(1.0, start.radius / std::max(length, 1e-9));
  disc.disc[kDiscX] = static_cast<float>(start.middle.x() - left_);
  disc.disc[kDiscY] = static_cast<float>(start.middle.y() - top_);
  disc.disc[kDiscRadius] = static_cast<float>(start.radius);
  disc.disc[kDiscAmbient] = static_cast<float>(start.around + (start.ball - start.around) / covered);
  disc.disc[kDiscAround] = static_cast<float>(start.around);
  disc.motion.half_x = static_cast<float>(half.x());
  disc.motion.half_y = static_cast<float>(half.y());
  return disc;
}

double SmearFit::squaresAtRest(const DiscValues& disc) {
  DiscSums sums;
  measureDisc(disc, *cells_, sums);
  return sums.squares;
}

std::optional<SmearedBall> SmearFit::fit(const CellGrid& grid, const Eigen::Vector3d& axis,
                                         const SmearStart& start, const DiscValues* at_rest,
                                         double most_excess) {
  if (!readAlong(grid, axis, start)) return std::nullopt;
  DiscCells& cells = *cells_;
  SmearedDisc smeared = startingFrom(start);
  double squares_at_rest = std::numeric_limits<double>::infinity();
  if (at_rest != nullptr) {
    DiscValues disc = *at_rest;
    disc[kDiscX] -= static_cast<float>(left_);
    disc[kDiscY] -= static_cast<float>(top_);
    squares_at_rest = squaresAtRest(disc);
    // A ball on a longer way is no start: its light makes up for what is no ball at rest.
    if (start.half.squaredNorm() < kShort * kShort * start.radius * start.radius) {
      const float radius = smeared.disc[kDiscRadius];
      smeared.disc = disc;
      smeared.disc[kDiscRadius] = std::min(radius, disc[kDiscRadius]);
    }
  }
  smeared.descend(cells, kFirstSteps);
  smeared.measure(cells);
  const double variance = std::pow(noiseAround(cells, room_), 2);
  if (smeared.squares + kSoonGained * variance > squares_at_rest ||
      smeared.squares / variance - smeared.count > most_excess + kStillToFall * smeared.count)
    return std::nullopt;
  smeared.descend(cells, kSteps);
  return ballOf(smeared, start, squares_at_rest);
}

std::optional<SmearedBall> SmearFit::ballOf(const SmearedDisc& smeared, const SmearStart& start,
                                            double squares_at_rest) {
  DiscCells& cells = *cells_;
  const DiscSums sums = smeared.measure(cells);
  SmearedBall ball;
  ball.centre = {left_ + static_cast<double>(smeared.disc[kDiscX]),
                 top_ + static_cast<double>(smeared.disc[kDiscY])};
  ball.half = {smeared.motion.half_x, smeared.motion.half_y};
  ball.radius = smeared.disc[kDiscRadius];
  ball.contrast =
      smeared.disc[kDiscAmbient] + std::max(0.0F, smeared.disc[kDiscLightZ]) - smeared.disc[kDiscAround];
  ball.noise = noiseAround(cells, room_);
  const double variance = sums.squares / std::max(1.0, sums.count - double{kSmearParameters});
  ball.misfit = variance / (ball.noise * ball.noise);
  ball.excess = sums.squares / (ball.noise * ball.noise) - sums.count;
  ball.gain = (squares_at_rest - sums.squares) / std::max(variance, kLeastVariance);
  ball.covariance = centreCovariance(smeared, sums, kLeastVariance);
  for (std::size_t i = 0; i < real_count_; ++i) ball.seen += cells.cover[i];
  const bool is_plausible = ball.half.norm() < kMostHalf * ball.radius &&
                            ball.radius > kSmaller * start.radius &&
                            ball.radius < kLarger * start.radius + 1.0 &&
                            (ball.centre - start.middle).norm() < start.radius + kApart;
  return is_plausible ? std::optional(ball) : std::nullopt;
}

}  // namespace helical
