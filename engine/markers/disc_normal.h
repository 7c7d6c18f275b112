#pragma once

#include <Eigen/Core>

#include "engine/markers/disc_kernels.h"

namespace helical {

inline constexpr float kSmallestDisc = 0.7F;  ///< cells: below that radius there is no disc
inline constexpr float kLeastScale = 0.7F;    ///< levels: quantisation and what the models leave out
/// Squared levels: no fit is believed to scatter by less than half of that.
inline constexpr double kLeastVariance = 0.25 * kLeastScale * kLeastScale;

/// Normal matrix of the first `kSize` parameters; sumDisc and sumCutDisc fill the lower triangle.
template <int kSize>
Eigen::Matrix<double, kSize, kSize> normalOf(const DiscSums& sums) {
  Eigen::Matrix<double, kSize, kSize> normal;
  for (int a = 0; a < kSize; ++a)
    for (int b = 0; b <= a; ++b)
      normal(a, b) = normal(b, a) = sums.normal[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
  return normal;
}

/// Information about the light along the view, which is zero as far as anybody knows: under flat light its
/// direction shows nowhere.
inline double lightPrior(double ambient) {
  return 4.0 / (1.0 + ambient * ambient);
}

}  // namespace helical
