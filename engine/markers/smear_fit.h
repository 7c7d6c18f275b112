#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "engine/markers/cell_grid.h"
#include "engine/markers/disc_kernels.h"
#include "engine/markers/smeared_disc.h"

namespace helical {

/// What a smeared ball looks like at first sight, in cells of the image.
struct SmearStart {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  Eigen::Vector2d half = Eigen::Vector2d::Zero();  ///< of its way
  double radius = 0.0;
  double ball = 0.0;    ///< level of the brightest
  double around = 0.0;  ///< level
};

/// A ball that moved while the shutter was open, fitted.
struct SmearedBall {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< in the middle of its way
  Eigen::Vector2d half = Eigen::Vector2d::Zero();    ///< of its way
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();
  double radius = 0.0;
  double contrast = 0.0;  ///< levels, where the ball faces the camera
  double noise = 0.0;     ///< levels, around it
  double misfit = 0.0;    ///< mean square of the residuals over that of the noise
  double excess = 0.0;    ///< chi-square of the residuals over what is expected of noise alone
  double gain = 0.0;      ///< chi-square that the motion takes off what a ball at rest leaves
  double seen = 0.0;      ///< of the disc's area, in cells
};

/// Fits SmearedDisc to the cells along the way of a ball. Allocates in the constructor only. One thread.
class SmearFit {
 public:
  SmearFit();

  /// Values are a cell's colours along `axis`. `at_rest`, if given, is what was fitted before as a ball at
  /// rest, in cells of the image. Nothing if what comes out is no ball on its way, or too large, or explains
  /// no more than the ball at rest, or soon seems to come out at more than `most_excess`.
  std::optional<SmearedBall> fit(const CellGrid& grid, const Eigen::Vector3d& axis, const SmearStart& start,
                                 const DiscValues* at_rest, double most_excess);

 private:
  bool readAlong(const CellGrid& grid, const Eigen::Vector3d& axis, const SmearStart& start);
  SmearedDisc startingFrom(const SmearStart& start) const;
  double squaresAtRest(const DiscValues& disc);
  std::optional<SmearedBall> ballOf(const SmearedDisc& smeared, const SmearStart& start,
                                    double squares_at_rest);

  int left_ = 0;  ///< of the window, which parameters are counted from
  int top_ = 0;
  std::size_t real_count_ = 0;  ///< of the cells, without what only fills up
  std::unique_ptr<DiscCells> cells_;
  std::vector<float> room_;  ///< for medians
};

}  // namespace helical
