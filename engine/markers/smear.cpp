#include "engine/markers/smear.h"

#include <algorithm>
#include <cmath>

namespace helical {
namespace {

/// The shorter axis' skewness over the root of the moments' excess: 0 of a smeared ball, 0.16 of one that
/// something hides a tenth to a half of, from one side.
constexpr double kMostSkew = 0.07;
constexpr double kMostHidden = 4.0;   ///< elongation; nothing hides so much of a ball
constexpr double kSmearSigma = 0.03;  ///< of the smear's length, measured with drawn balls

struct Cell {
  double share = 0.0;  ///< of the ball
  Eigen::Vector2d at;
};

/// Shares from a quarter to three quarters of the ball's level: sharper than its outline, less noisy.
Cell cellOf(const SmearCells& cells, std::size_t i) {
  const double above = static_cast<double>(cells.value[i]) - cells.level;
  return {std::clamp(0.5 + above / std::max(1.0, cells.contrast), 0.0, 1.0),
          Eigen::Vector2d(cells.x[i], cells.y[i])};
}

}  // namespace

Smear measureSmear(const SmearCells& cells) {
  Smear smear;
  double sum = 0.0;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < cells.x.size(); ++i) {
    const Cell cell = cellOf(cells, i);
    sum += cell.share;
    middle += cell.share * cell.at;
  }
  if (!(sum > 1.0)) return smear;
  middle /= sum;
  Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < cells.x.size(); ++i) {
    const Cell cell = cellOf(cells, i);
    moments += cell.share / sum * (cell.at - middle) * (cell.at - middle).transpose();
  }
  const double mean = 0.5 * moments.trace(), half = 0.5 * (moments(0, 0) - moments(1, 1));
  const double turn = std::sqrt(half * half + moments(0, 1) * moments(0, 1));
  const double longer = mean + turn, shorter = mean - turn;
  if (!(shorter > 0.0)) return smear;
  smear.middle = middle;
  smear.longer = longer;
  smear.shorter = shorter;
  if (!(turn > 0.0)) return smear;
  smear.elongation = longer / shorter;
  // Of the two forms of the eigenvector, that which does not cancel.
  Eigen::Vector2d axis =
      half > 0.0 ? Eigen::Vector2d(half + turn, moments(0, 1)) : Eigen::Vector2d(moments(0, 1), turn - half);
  axis.normalize();
  smear.axis = axis;
  double skew = 0.0;
  for (std::size_t i = 0; i < cells.x.size(); ++i) {
    const Cell cell = cellOf(cells, i);
    const Eigen::Vector2d apart = cell.at - middle;
    const double across = axis.x() * apart.y() - axis.y() * apart.x();
    skew += cell.share / sum * across * across * across;
  }
  const double limit = kMostSkew * kMostSkew * (smear.elongation - 1.0);
  smear.one_sided = smear.elongation < kMostHidden && skew * skew > limit * shorter * shorter * shorter;
  const double variance = kSmearSigma * kSmearSigma * 12.0 * (longer - shorter);
  smear.covariance = variance * (smear.one_sided ? Eigen::Matrix2d(Eigen::Matrix2d::Identity())
                                                 : Eigen::Matrix2d(axis * axis.transpose()));
  return smear;
}

}  // namespace helical
