#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "engine/markers/ball_window.h"
#include "engine/markers/cell_grid.h"
#include "engine/markers/overlap_split.h"
#include "engine/markers/region_labeller.h"
#include "engine/markers/shaded_disc.h"
#include "engine/markers/smear.h"
#include "engine/markers/smear_fit.h"

namespace helical {

/// A ball's outline in the image, in cells.
struct Disc {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();
  double radius = 0.0;
  double seen_share = 1.0;  ///< of the disc's area; the rest is hidden by something else
  /// Of a ball that moved while the shutter was open: from its centre, in the middle of its way, to the end.
  Eigen::Vector2d half_way = Eigen::Vector2d::Zero();
};

/// Fits the picture of a shaded ball to the cells around a region: least squares over the centre, the radius,
/// the ambient and the directed light, and the level of what is around it,
///   value(x, y) = around + cover(x, y) (ambient + max(0, light . normal(x, y)) - around),
/// with the share of the cell that the disc covers and the normal of the sphere there. What is fitted first
/// is the colour's part along the ball's own, so that grey surroundings, whatever their brightness, look
/// alike; then, where the surroundings are even, the brightness as well, with the same light and a level of
/// its own, each cell of both by the scatter around the fit. Where that does not fit, or a motion explains
/// what is left better than chance, the ball moved while the shutter was open (SmearFit), or something hides
/// a part of it: a straight edge before the disc is fitted, too. If there is none, the circle that most of
/// the outline lies on is the start, and cells that do not fit are left out. The covariance is that of the
/// fit, with the scatter of the residuals: squared errors are 0.6 to 1.7 of it. What discCentroid adds for
/// the outline's sampling, 0.037 cells over the root of the radius as rendered pictures need it, is more than
/// that before little noise: of pictures sampled finely, squared errors are 0.06 to 0.5 of the centroid's.
/// Repeats bit for bit on any machine. Allocates in the constructor only. One thread.
class DiscFit {
 public:
  DiscFit() = default;
  DiscFit(const DiscFit&) = delete;

  /// Nothing if the region is too large for the workspace, or nothing that looks like a ball; or if it is
  /// longish and alike on both sides, but no ball that moved evenly: its centre of gravity is the better
  /// estimate.
  std::optional<Disc> fit(const CellGrid& grid, const Region& region);
  /// Of the last region fitted: what its smear adds to the covariance of its centre of gravity, in cells.
  const Eigen::Matrix2d& smear() const { return smear_; }
  /// The discs of two balls that touch or overlap; nothing if the region does not look like that. Each is
  /// fitted without the cells that are the other's, too.
  std::optional<std::array<Disc, 2>> fitTwo(const CellGrid& grid, const Region& region);

 private:
  std::optional<Disc> fitWindow(const CellGrid& grid);
  std::optional<Disc> fitColour(const CellGrid& grid);
  std::optional<Disc> withBrightness(const Disc& by_colour);
  Disc fitPart(const CellGrid& grid, Region part, const OutlineCircle& mine, const OutlineCircle& other);
  std::optional<Disc> fitMovingOrCut(const CellGrid& grid, const Smear& smear, double motion);
  std::optional<SmearedBall> fitMoving(const CellGrid& grid, const Smear& smear, const DiscValues* at_rest,
                                       double most_excess);
  std::optional<Disc> fitCut(double& excess);
  OutlineCircle outlineOfRest() const;
  Smear smearOfRegion() const;
  bool isOneMoving(const CellGrid& grid);
  std::optional<Disc> result();
  /// The disc at the current parameters, with the cells of it that are seen; nothing if it is doubtful or its
  /// covariance is none.
  std::optional<Disc> believed(const Eigen::Matrix2d& covariance, double seen) const;
  bool isPlausible() const;
  bool isDoubtful(const Disc& disc) const;
  bool isDoubtful(const SmearedBall& ball, const SmearStart& start, const Smear& smear) const;
  double squaredFromRegion() const;

  BallWindow window_;
  ShadedDisc disc_{window_};
  SmearFit smear_fit_;
  OverlapSplit split_;
  Eigen::Matrix2d smear_ = Eigen::Matrix2d::Zero();
};

}  // namespace helical
