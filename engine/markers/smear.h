#pragma once

#include <Eigen/Core>
#include <span>

namespace helical {

/// Cells of a ball and of what is around it, their centres from any origin.
struct SmearCells {
  std::span<const float> x, y, value;
  double level = 0.0;     ///< between the ball's and that of its surroundings
  double contrast = 0.0;  ///< from there to the ball's
};

/// A ball that moved while the shutter was open: longish, and alike on both sides of its way. One that
/// something hides in part is longish, too, and one-sided.
struct Smear {
  double elongation = 1.0;  ///< second moments, along the longer axis over along the shorter one
  bool one_sided = true;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();  ///< centre of gravity, from the cells' origin
  Eigen::Vector2d axis = Eigen::Vector2d::UnitX();   ///< the longer one
  double longer = 0.0, shorter = 0.0;                ///< second moments along the axes [cells^2]
  /// What the motion adds to the covariance of the centre of gravity, or in every direction what made it
  /// one-sided [cells^2].
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();

  /// Whether it is a smeared ball, if it is longer than that.
  bool isOver(double least_elongation) const { return elongation > least_elongation && !one_sided; }
};

/// From second moments and the skewness of the shorter axis. Where there is no ball, no smear: moments of 0.
Smear measureSmear(const SmearCells& cells);

}  // namespace helical
