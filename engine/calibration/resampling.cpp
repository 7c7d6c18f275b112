#include "engine/calibration/resampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "engine/base/check.h"
#include "engine/calibration/vector_math.h"

namespace helical {
namespace {

using Lanes = std::array<float, kLanes>;

HELICAL_VECTOR_CLONES
float largestOf(const float* values, std::size_t count) {
  constexpr float kLeast = -std::numeric_limits<float>::infinity();
  Lanes largest;
  for (float& lane : largest) lane = kLeast;
  const std::size_t whole = count - count % kLanes;
  for (std::size_t i = 0; i < whole; i += kLanes)
    for (std::size_t k = 0; k < kLanes; ++k) {
      const float value = values[i + k], before = largest[k];
      largest[k] = value > before ? value : before;
    }
  for (std::size_t i = whole; i < count; ++i) largest[0] = values[i] > largest[0] ? values[i] : largest[0];
  float result = kLeast;
  for (const float lane : largest) result = lane > result ? lane : result;
  return result;
}

/// weights = exp(log_weights - largest); returns their sum.
HELICAL_VECTOR_CLONES
float exponentials(const float* log_weights, float largest, float* weights, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) weights[i] = expOfNegative(log_weights[i] - largest);
  Lanes sums{};
  const std::size_t whole = count - count % kLanes;
  for (std::size_t i = 0; i < whole; i += kLanes)
    for (std::size_t k = 0; k < kLanes; ++k) sums[k] += weights[i + k];
  for (std::size_t i = whole; i < count; ++i) sums[0] += weights[i];
  float sum = 0.0F;
  for (const float part : sums) sum += part;
  return sum;
}

HELICAL_VECTOR_CLONES
float sumOfSquares(const float* values, std::size_t count) {
  Lanes sums{};
  const std::size_t whole = count - count % kLanes;
  for (std::size_t i = 0; i < whole; i += kLanes)
    for (std::size_t k = 0; k < kLanes; ++k) sums[k] += values[i + k] * values[i + k];
  for (std::size_t i = whole; i < count; ++i) sums[0] += values[i] * values[i];
  float sum = 0.0F;
  for (const float part : sums) sum += part;
  return sum;
}

}  // namespace

void systematicResample(std::span<const float> weights, double uniform, std::span<int> parents) {
  HELICAL_CHECK(!weights.empty() && weights.size() == parents.size());
  const double share = 1.0 / static_cast<double>(weights.size());
  std::size_t child = 0;
  double cumulated = 0.0;
  for (std::size_t parent = 0; parent + 1 < weights.size(); ++parent) {
    cumulated += static_cast<double>(weights[parent]);
    while (child < parents.size() && (static_cast<double>(child) + uniform) * share < cumulated)
      parents[child++] = static_cast<int>(parent);
  }
  while (child < parents.size()) parents[child++] = static_cast<int>(weights.size() - 1);
}

double effectiveSampleSize(std::span<const float> weights) {
  const float squares = sumOfSquares(weights.data(), weights.size());
  return squares > 0.0F ? 1.0 / static_cast<double>(squares) : 0.0;
}

float normaliseLogWeights(std::span<const float> log_weights, std::span<float> weights) {
  const float largest = largestOf(log_weights.data(), log_weights.size());
  if (!std::isfinite(largest)) {
    std::fill(weights.begin(), weights.end(), 1.0F / static_cast<float>(weights.size()));
    return 0.0F;
  }
  const float scale = 1.0F / exponentials(log_weights.data(), largest, weights.data(), log_weights.size());
  for (float& w : weights) w *= scale;
  return largest;
}

}  // namespace helical
