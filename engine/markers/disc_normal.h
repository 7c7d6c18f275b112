#pragma once

#include <Eigen/Core>
#include <array>

#include "engine/markers/disc_kernels.h"

namespace helical {

inline constexpr float kSmallestDisc = 0.7F;  ///< cells: below that radius there is no disc
inline constexpr float kLeastScale = 0.7F;    ///< levels: quantisation and what the models leave out
/// Squared levels: no fit is believed to scatter by less than half of that.
inline constexpr double kLeastVariance = 0.25 * kLeastScale * kLeastScale;

/// Normal matrix of the first `kSize` parameters, of which sums have the lower triangle.
template <int kSize>
Eigen::Matrix<double, kSize, kSize> normalOf(const DiscSums& sums) {
  Eigen::Matrix<double, kSize, kSize> normal;
  for (int a = 0; a < kSize; ++a)
    for (int b = 0; b <= a; ++b)
      normal(a, b) = normal(b, a) = sums.normal[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
  return normal;
}

/// Solves normal equations: a root-free Cholesky decomposition without pivoting, which unknowns that hardly
/// differ in scale and a size known beforehand do not need. What the equations say nothing of stays zero.
template <int kSize>
class NormalSolver {
 public:
  using Vector = Eigen::Matrix<double, kSize, 1>;

  explicit NormalSolver(const Eigen::Matrix<double, kSize, kSize>& normal) {
    constexpr double kNothing = 1e-12;  // of the unknown's own information
    for (int k = 0; k < kSize; ++k) {
      double left = normal(k, k);
      for (int j = 0; j < k; ++j) {
        double product = normal(k, j);
        for (int i = 0; i < j; ++i) product -= scaled_(k, i) * lower_(j, i);
        scaled_(k, j) = product;
        lower_(k, j) = product * inverse_[j];
        left -= product * lower_(k, j);
      }
      inverse_[k] = left > kNothing * normal(k, k) ? 1.0 / left : 0.0;
      // One that others explain as a whole may be anything; one that shows nowhere has no say.
      variance_[k] =
          inverse_[k] > 0.0 || !(normal(k, k) > 0.0) ? inverse_[k] : 1.0 / (kNothing * normal(k, k));
    }
  }

  Vector solve(Vector x) const {
    for (int k = 0; k < kSize; ++k)
      for (int j = 0; j < k; ++j) x[k] -= lower_(k, j) * x[j];
    for (int k = kSize - 1; k >= 0; --k) {
      x[k] *= inverse_[k];
      for (int j = k + 1; j < kSize; ++j) x[k] -= lower_(j, k) * x[j];
    }
    return x;
  }

  /// Inverse of the matrix, of its first two unknowns.
  Eigen::Matrix2d firstTwo() const {
    Eigen::Matrix<double, kSize, 2> x = Eigen::Matrix<double, kSize, 2>::Identity();
    for (int k = 0; k < kSize; ++k)
      for (int j = 0; j < k; ++j) x.row(k) -= lower_(k, j) * x.row(j);
    return x.transpose() * variance_.asDiagonal() * x;
  }

 private:
  Eigen::Matrix<double, kSize, kSize> lower_, scaled_;  ///< the same, with the diagonal multiplied in
  Vector inverse_;                                      ///< of the diagonal
  Vector variance_;                                     ///< the same, as far as the covariance goes
};

/// Information about the light along the view, which is zero as far as anybody knows: under flat light its
/// direction shows nowhere.
inline double lightPrior(double ambient) {
  return 4.0 / (1.0 + ambient * ambient);
}

}  // namespace helical
