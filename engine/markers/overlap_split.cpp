#include "engine/markers/overlap_split.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace helical {
namespace {

constexpr std::size_t kMostPoints = 600;
constexpr std::size_t kFewestPoints = 16;
constexpr int kSmallestArea = 20;  ///< cells
constexpr double kLongish = 1.2;   ///< longer over shorter side: one ball is hardly longer
constexpr double kEmptyish = 0.7;  ///< of its box: a disc fills 0.79
constexpr int kTriples = 240;
constexpr double kMostUnequal = 0.6;  ///< of two balls' radii
constexpr double kNearest = 1.1;      ///< radii between two centres: below, their waist is too slight
constexpr double kExplained = 0.85;   ///< of the outline
constexpr double kSecondShare = 0.2;
constexpr double kFull = 0.92;
constexpr double kLeftOver = 0.06;
/// Cells, of the waist of two discs: what square cells fill of its depth (0.4 to 0.9, the sharper the more),
/// and how deep at least it must be. A smeared ball has none.
constexpr double kFilled = 0.6, kLeastWaist = 0.35;
/// Of the depth that the circles and their filling leave: halfway between the waist of two discs and none,
/// which is a smeared ball's.
constexpr double kWaistSeen = 0.5;
constexpr double kEdge = 0.7;  ///< cells: half a cell's diagonal

double distance(double x, double y, const OutlinePoint& point) {
  return std::sqrt((x - point.x) * (x - point.x) + (y - point.y) * (y - point.y));
}

/// Whether both circles are full and next to nothing lies outside of them.
bool covers(const ValueWindow& window, const std::array<OutlineCircle, 2>& pair) {
  int inside = 0, full = 0, set = 0, left_over = 0;
  for (int y = 0; y < window.height; ++y)
    for (int x = 0; x < window.width; ++x) {
      const double depth = std::max(pair[0].radius - distance(x, y, pair[0].centre),
                                    pair[1].radius - distance(x, y, pair[1].centre));
      const bool is_set = window.isInside(x, y);
      inside += depth > kEdge ? 1 : 0;
      full += depth > kEdge && is_set ? 1 : 0;
      set += is_set ? 1 : 0;
      left_over += is_set && depth < -kEdge ? 1 : 0;
    }
  return full > kFull * inside && left_over < kLeftOver * set;
}

/// The value between four cells; the level itself beyond the window.
float valueAt(const ValueWindow& window, double x, double y) {
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  if (i < 0 || j < 0 || i + 1 >= window.width || j + 1 >= window.height) return window.level;
  const auto a = static_cast<float>(x - i), b = static_cast<float>(y - j);
  const float *upper = window.values + j * window.width + i, *lower = upper + window.width;
  return (1.0F - b) * ((1.0F - a) * upper[0] + a * upper[1]) + b * ((1.0F - a) * lower[0] + a * lower[1]);
}

/// How far the outline lies from a place in a direction; `most` if there is none up to there.
double reach(const ValueWindow& window, const OutlinePoint& from, double nx, double ny, double most) {
  constexpr double kStep = 0.125;
  for (double d = 0.0; d < most; d += kStep)
    if (valueAt(window, from.x + d * nx, from.y + d * ny) <= window.level) return d;
  return most;
}

bool hasWaist(const ValueWindow& window, const std::array<OutlineCircle, 2>& pair) {
  const double dx = pair[1].centre.x - pair[0].centre.x, dy = pair[1].centre.y - pair[0].centre.y;
  const double apart = std::sqrt(dx * dx + dy * dy), nx = dx / apart, ny = dy / apart;
  // Where the circles cross, or the middle of the gap between them.
  const double r0 = pair[0].radius, r1 = pair[1].radius;
  const double along = std::clamp(0.5 * (apart + (r0 * r0 - r1 * r1) / apart), 0.0, apart);
  const double half = std::sqrt(std::max(0.0, r0 * r0 - along * along));
  const OutlinePoint middle{pair[0].centre.x + along * nx, pair[0].centre.y + along * ny};
  const double smaller = std::min(r0, r1);
  const double most = smaller - std::max(kLeastWaist, kWaistSeen * (smaller - half - kFilled));
  const double sum = reach(window, middle, -ny, nx, smaller) + reach(window, middle, ny, -nx, smaller);
  return 0.5 * sum < most;
}

}  // namespace

OverlapSplit::OverlapSplit() {
  outline_.reserve(kMostPoints);
}

bool OverlapSplit::mayBeTwo(const Region& region) {
  const double width = region.right - region.left + 1, height = region.bottom - region.top + 1;
  const auto area = static_cast<double>(region.area);
  return area >= kSmallestArea &&
         (std::max(width, height) > kLongish * std::min(width, height) || area < kEmptyish * width * height);
}

std::optional<std::array<OutlineCircle, 2>> OverlapSplit::circles(const ValueWindow& window) {
  collectOutline(window);
  const std::size_t all = outline_.size();
  if (all < kFewestPoints || all >= kMostPoints) return std::nullopt;
  const double longest = std::max(window.width, window.height);
  const auto first = largestGroup(1.5, 0.5 * longest);
  if (!first) return std::nullopt;
  const std::size_t on_first = removeOn(*first);
  const auto second = largestGroup(kMostUnequal * first->radius, first->radius / kMostUnequal);
  if (!second) return std::nullopt;
  const std::size_t on_second = removeOn(*second);
  const auto share = static_cast<double>(all);
  if (static_cast<double>(on_first + on_second) < kExplained * share ||
      static_cast<double>(on_second) < kSecondShare * share)
    return std::nullopt;
  const std::array<OutlineCircle, 2> pair{*first, *second};
  const double apart = distance(first->centre.x, first->centre.y, second->centre);
  if (apart < kNearest * 0.5 * (first->radius + second->radius)) return std::nullopt;
  return covers(window, pair) && hasWaist(window, pair) ? std::optional(pair) : std::nullopt;
}

Region OverlapSplit::partOf(const ValueWindow& window, const OutlineCircle& mine,
                            const OutlineCircle& other) {
  Region part;
  part.left = window.width;
  part.top = window.height;
  for (int y = 0; y < window.height; ++y)
    for (int x = 0; x < window.width; ++x) {
      if (!window.isInside(x, y) ||
          distance(x, y, mine.centre) - mine.radius > distance(x, y, other.centre) - other.radius)
        continue;
      ++part.area;
      part.sum_x += x;
      part.sum_y += y;
      part.left = std::min(part.left, x);
      part.right = std::max(part.right, x);
      part.top = std::min(part.top, y);
      part.bottom = std::max(part.bottom, y);
    }
  return part;
}

void OverlapSplit::collectOutline(const ValueWindow& window) {
  outline_.clear();
  const auto add = [&](int x, int y, int dx, int dy) {
    if (outline_.size() == kMostPoints || window.isInside(x, y) == window.isInside(x + dx, y + dy)) return;
    const float here = window.values[y * window.width + x],
                there = window.values[(y + dy) * window.width + x + dx];
    const double at = static_cast<double>((window.level - here) / (there - here));
    outline_.push_back({x + at * dx, y + at * dy});
  };
  for (int y = 0; y < window.height; ++y)
    for (int x = 0; x < window.width; ++x) {
      if (x + 1 < window.width) add(x, y, 1, 0);
      if (y + 1 < window.height) add(x, y, 0, 1);
    }
}

std::optional<OutlineCircle> OverlapSplit::largestGroup(double least_radius, double most_radius) const {
  std::optional<OutlineCircle> best;
  int most = 0;
  std::uint32_t draw = 12345;
  const auto drawn = [&] {
    draw = draw * 1664525U + 1013904223U;
    return outline_[(draw >> 8) % outline_.size()];
  };
  if (outline_.size() < 3) return best;
  for (int i = 0; i < kTriples; ++i) {
    const OutlinePoint a = drawn(), b = drawn(), c = drawn();
    const auto circle = circleThrough(a, b, c);
    if (!circle || circle->radius < least_radius || circle->radius > most_radius) continue;
    const int count = pointsOn(*circle, outline_);
    if (count <= most) continue;
    most = count;
    best = circle;
  }
  return best ? throughPointsOn(*best, outline_) : best;
}

std::size_t OverlapSplit::removeOn(const OutlineCircle& circle) {
  const auto rest = std::remove_if(outline_.begin(), outline_.end(), [&](const OutlinePoint& point) {
    return std::abs(distance(point.x, point.y, circle.centre) - circle.radius) < kEdge;
  });
  const auto removed = static_cast<std::size_t>(outline_.end() - rest);
  outline_.erase(rest, outline_.end());
  return removed;
}

}  // namespace helical
