#pragma once

#include <Eigen/Core>
#include <array>

#include "engine/markers/disc_kernels.h"

namespace helical {

/// The picture of a shaded ball that moved evenly while the shutter was open: DiscFit's model, meant over its
/// way. Levenberg and Marquardt over all of it. Repeats bit for bit. No allocation.
struct SmearedDisc {
  static constexpr int kSize = kSmearParameters;

  DiscValues disc{};  ///< in the middle of its way
  DiscMotion motion;
  double squares = 0.0;  ///< of the residuals over the given cells
  double count = 0.0;    ///< of the given cells

  double halfLength() const;
  /// To the least squares near to where it stands, with as many moments as its way may take.
  void descend(DiscCells& cells, int steps);
  /// Fills the cells' residuals and cover.
  DiscSums measure(DiscCells& cells) const;
  SmearedDisc moved(const Eigen::Matrix<double, kSize, 1>& change) const;
};

}  // namespace helical
