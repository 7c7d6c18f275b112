#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <span>

#include "engine/markers/ball_outline.h"
#include "engine/markers/cell_grid.h"
#include "engine/markers/cut_disc.h"
#include "engine/markers/disc_kernels.h"
#include "engine/markers/overlap_split.h"
#include "engine/markers/region_labeller.h"
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
/// fit, with the scatter of the residuals. Repeats bit for bit on any machine. Allocates in the constructor
/// only. One thread.
class DiscFit {
 public:
  DiscFit();

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
  static constexpr int kLargestSide = 88;
  using Parameters = std::array<float, kDiscParameters>;
  struct System;

  bool readWindow(const CellGrid& grid, const Region& region);
  Eigen::Vector3d colourAxis(const CellGrid& grid, const Region& region) const;
  double valueAt(double x, double y) const;
  void start(const OutlineCircle& circle);
  Disc fitPart(const CellGrid& grid, Region part, const OutlineCircle& mine, const OutlineCircle& other);
  ValueWindow window(const Region& region);
  Smear smearOfRegion();
  float givenAt(double x, double y) const;
  std::optional<Disc> fitWindow(const CellGrid& grid);
  std::optional<Disc> fitColour(const CellGrid& grid);
  std::optional<SmearedBall> fitMoving(const CellGrid& grid, const Smear& smear, const Parameters* at_rest,
                                       double most_excess);
  bool isOneMoving(const CellGrid& grid);
  std::optional<Disc> fitMovingOrCut(const CellGrid& grid, const Smear& smear);
  std::optional<Disc> fitCut(double& excess);
  bool mayHaveMoved(const Smear& smear);
  double motionInResiduals();
  std::optional<Disc> withBrightness(const Disc& by_colour);
  bool startBrightness();
  void levelBrightness();
  void leaveOutUneven(float limit);
  Parameters brightnessParameters() const;
  System linearise();
  bool descend(int steps);
  float residualScale(const DiscCells& cells);
  bool fitsEverywhere();
  float noiseAround();
  void leaveOutHidden();
  void leaveOutMarked(DiscCells& cells);
  std::optional<Disc> result();
  /// The disc at the current parameters, with the cells of it that are seen; nothing if it is doubtful or its
  /// covariance is none.
  std::optional<Disc> believed(const Eigen::Matrix2d& covariance, double seen) const;
  int traceOutline(std::span<OutlinePoint> outline) const;
  bool isPlausible() const;
  bool isDoubtful(const Disc& disc) const;
  bool isDoubtful(const SmearedBall& ball, const SmearStart& start, const Smear& smear) const;
  std::size_t placeOf(std::size_t cell) const;

  int left_ = 0;
  int top_ = 0;
  int width_ = 0;
  int height_ = 0;
  Eigen::Matrix2d smear_ = Eigen::Matrix2d::Zero();
  Region region_;
  OutlineCircle binary_{};  ///< of the region; like the parameters from the window's corner on
  std::optional<OutlineCircle> neighbour_;
  Eigen::Vector3d axis_ = Eigen::Vector3d::UnitX();  ///< of the colours, along which values are taken
  bool has_colour_ = false;
  Parameters p_{};
  float brightness_over_colour_ = 0.0F;  ///< of the ball's light
  float brightness_around_ = 0.0F;
  double brightness_weight_ = 0.0;  ///< of a cell's brightness, over that of its colour; 0: not fitted
  std::size_t real_count_ = 0;      ///< of the cells, without what only fills up
  std::array<float, kLargestSide * kLargestSide> values_;
  std::array<float, kDiscCells> sorted_;
  std::array<std::uint8_t, kLargestSide * kLargestSide> is_marked_;  ///< does not fit
  std::unique_ptr<DiscCells> colour_;
  std::unique_ptr<DiscCells> brightness_;
  OverlapSplit split_;
  SmearFit smear_fit_;
};

}  // namespace helical
