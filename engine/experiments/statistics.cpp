#include "engine/experiments/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace helical {
namespace {

constexpr double kZ95 = 1.959963984540054;  // standard normal deviate of a two-sided 95 %

}  // namespace

double quantile(std::vector<double> values, double fraction) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  for (double& value : values)
    if (!std::isfinite(value)) value = std::numeric_limits<double>::infinity();
  std::sort(values.begin(), values.end());
  const double place = fraction * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  const double share = place - static_cast<double>(below);
  // An infinite value less itself, or times 0, would be NaN.
  if (share == 0.0 || !std::isfinite(values[below])) return values[below];
  return values[below] + share * (values[above] - values[below]);
}

Interval quantileInterval(const std::vector<double>& values, double fraction) {
  if (values.empty()) return {quantile(values, fraction), quantile(values, fraction), quantile(values, fraction)};
  const double n = static_cast<double>(values.size());
  const double half = kZ95 * std::sqrt(fraction * (1.0 - fraction) / n);
  const double last = std::max(1.0, n - 1.0);
  // Whole ranks, outwards: between two values the interval would be too narrow.
  const auto rank = [&](double share, bool up) {
    const double place = std::clamp(share, 0.0, 1.0) * last;
    return (up ? std::ceil(place) : std::floor(place)) / last;
  };
  return {quantile(values, fraction), quantile(values, rank(fraction - half, false)),
          quantile(values, rank(fraction + half, true))};
}

Proportion proportion(int successes, int runs) {
  if (runs == 0) return {};
  const double n = runs, p = successes / n, z2 = kZ95 * kZ95;
  const double centre = (p + z2 / (2.0 * n)) / (1.0 + z2 / n);
  const double half = kZ95 / (1.0 + z2 / n) * std::sqrt(p * (1.0 - p) / n + z2 / (4.0 * n * n));
  return {p, std::max(0.0, centre - half), std::min(1.0, centre + half)};
}

}  // namespace helical
