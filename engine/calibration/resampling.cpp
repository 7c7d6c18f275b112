#include "engine/calibration/resampling.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/base/check.h"
#include "engine/calibration/exponential.h"

namespace helical {

void systematicResample(std::span<const double> weights, double uniform, std::span<int> parents) {
  HELICAL_CHECK(!weights.empty() && weights.size() == parents.size());
  const double share = 1.0 / static_cast<double>(weights.size());
  std::size_t parent = 0;
  double cumulated = weights[0];
  for (std::size_t i = 0; i < parents.size(); ++i) {
    const double position = (static_cast<double>(i) + uniform) * share;
    while (cumulated <= position && parent + 1 < weights.size()) cumulated += weights[++parent];
    parents[i] = static_cast<int>(parent);
  }
}

double effectiveSampleSize(std::span<const double> weights) {
  double squares = 0.0;
  for (const double w : weights) squares += w * w;
  return squares > 0.0 ? 1.0 / squares : 0.0;
}

void normaliseLogWeights(std::span<const double> log_weights, std::span<double> weights) {
  const double largest = *std::max_element(log_weights.begin(), log_weights.end());
  if (!std::isfinite(largest)) {
    std::fill(weights.begin(), weights.end(), 1.0 / static_cast<double>(weights.size()));
    return;
  }
  for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = expOfNegative(log_weights[i] - largest);
  double sum = 0.0;
  for (const double w : weights) sum += w;
  const double scale = 1.0 / sum;
  for (double& w : weights) w *= scale;
}

}  // namespace helical
