#include "ui/figures/fitted_axis.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace helical::figures {
namespace {

constexpr double kMostSteps = 6.0;

double roundStep(double span) {
  const double decade = std::pow(10.0, std::floor(std::log10(span / kMostSteps)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (span / (factor * decade) <= kMostSteps) return factor * decade;
  return 10.0 * decade;
}

}  // namespace

PlotAxis fittedAxis(const QString& title, double low, double high, double smallest) {
  const double missing = std::max({0.0, smallest - (high - low), 1e-9 - (high - low)});
  low -= 0.5 * missing;
  high += 0.5 * missing;
  const double step = roundStep(high - low);
  return plotAxis(title, step * std::floor(low / step + 1e-6), step * std::ceil(high / step - 1e-6), step);
}

PlotAxis fittedAxis(const QString& title, const std::vector<Curve>& curves, double smallest, double limit) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Curve& curve : curves) {
    for (const QPointF& point : curve.points) {
      if (!std::isfinite(point.y())) continue;
      low = std::min(low, std::clamp(point.y(), -limit, limit));
      high = std::max(high, std::clamp(point.y(), -limit, limit));
    }
  }
  if (low > high) return fittedAxis(title, 0.0, smallest, smallest);
  // What is never negative stands on its axis.
  if (low >= 0.0 && low < 0.5 * high) return fittedAxis(title, 0.0, std::max(high, smallest), 0.0);
  return fittedAxis(title, low, high, smallest);
}

}  // namespace helical::figures
