#pragma once

#include <Eigen/Core>
#include <array>

#include "engine/markers/disc_kernels.h"

namespace helical {

/// The picture of a shaded ball with the straight edge of something before it: DiscFit's model, and beyond
/// the edge a level of its own. Where the edge is nearly straight over the ball, cells on it say where the
/// ball ends as well as all others do. Levenberg and Marquardt over all of it. Repeats bit for bit. No
/// allocation.
struct CutDisc {
  static constexpr int kSize = kCutParameters;

  DiscValues disc{};
  CutEdge edge;
  double squares = 0.0;  ///< of the residuals over the given cells
  double count = 0.0;    ///< of the given cells

  /// To the least squares near to where it stands.
  void descend(DiscCells& cells, int steps);
  /// Fills the cells' residuals, and what is seen of them.
  DiscSums measure(DiscCells& cells) const;
  CutDisc moved(const Eigen::Matrix<double, kSize, 1>& change) const;
};

/// The best fit to cells around a region of which something hides a part, from whichever side: `disc` has the
/// region's centre of gravity and the radius of a disc of its area. The cells are left as measured by it.
struct NearestCut {
  CutDisc cut;
  Eigen::Matrix2d covariance;  ///< of the disc's centre
};
NearestCut nearestCut(const DiscValues& disc, DiscCells& cells);

}  // namespace helical
