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

  std::array<float, kDiscParameters> disc{};
  CutEdge edge;
  double squares = 0.0;  ///< of the residuals over the given cells
  double count = 0.0;    ///< of the given cells

  /// To the least squares near to where it stands.
  void descend(DiscCells& cells, int steps);
  /// Fills the cells' residuals, slopes, and what is seen of them.
  void evaluate(DiscCells& cells) const;
  /// The same, and their sums.
  DiscSums measure(DiscCells& cells) const;
  CutDisc moved(const Eigen::Matrix<double, kSize, 1>& change) const;
  /// Of the disc's centre, of cells just evaluated, whose residuals have at least that variance.
  Eigen::Matrix2d covariance(const DiscCells& cells, double least_variance) const;
};

/// The best fit to cells around a region of which something hides a part, from whichever side: `disc` has the
/// region's centre of gravity and the radius of a disc of its area.
CutDisc nearestCut(const std::array<float, kDiscParameters>& disc, DiscCells& cells);

/// Directed over ambient light: with less, nobody knows which side is dark, and a shadow that turns with the
/// noise keeps the fit from settling.
bool hasShadow(const std::array<float, kDiscParameters>& disc);

}  // namespace helical
