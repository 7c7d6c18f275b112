#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <span>

#include "engine/markers/cell_grid.h"
#include "engine/markers/disc_kernels.h"
#include "engine/markers/region_labeller.h"

namespace helical {

/// A ball's outline in the image, in cells.
struct Disc {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();
  double radius = 0.0;
  double seen_share = 1.0;  ///< of the disc's area; the rest is hidden by something else
};

/// Fits the picture of a shaded ball to the cells around a region: least squares over the centre, the radius,
/// the ambient and the directed light, and the level of what is around it,
///   value(x, y) = around + cover(x, y) (ambient + max(0, light . normal(x, y)) - around),
/// with the share of the cell that the disc covers and the normal of the sphere there. What is fitted is the
/// colour's part along the ball's own, so that grey surroundings, whatever their brightness, look alike.
/// Where the outline is not round, the circle that most of it lies on is the start, and cells that do not fit
/// lose their weight: something hides them. The covariance is that of the fit, with the scatter of the
/// residuals. Repeats bit for bit on any machine. Allocates in the constructor only. One thread.
class DiscFit {
 public:
  DiscFit();

  /// Nothing if the region is too large for the workspace, or nothing that looks like a ball.
  std::optional<Disc> fit(const CellGrid& grid, const Region& region);

 private:
  static constexpr int kLargestSide = 88;
  using Parameters = std::array<float, kDiscParameters>;
  struct Point {
    double x;
    double y;
  };
  struct Circle {
    Point centre;
    double radius;
  };

  bool readWindow(const CellGrid& grid, const Region& region);
  Eigen::Vector3d colourAxis(const CellGrid& grid, const Region& region) const;
  double valueAt(double x, double y) const;
  void start(const Circle& circle);
  bool descend(int steps);
  float residualScale();
  bool fitsEverywhere();
  void leaveOutHidden();
  std::optional<Disc> result();
  int traceOutline(std::span<Point> outline) const;
  int agreeing(std::span<const Point> outline, const Circle& circle) const;
  std::optional<Circle> bestCircle(std::span<const Point> outline) const;
  Circle throughAgreeing(std::span<const Point> outline, const Circle& circle) const;
  bool isPlausible() const;

  int left_ = 0;
  int top_ = 0;
  int width_ = 0;
  int height_ = 0;
  Circle binary_{};  ///< of the region; like the parameters from the window's corner on
  Parameters p_{};
  std::size_t real_count_ = 0;  ///< of the cells, without what only fills up
  std::array<float, kLargestSide * kLargestSide> values_;
  std::array<float, kDiscCells> sorted_;
  std::array<std::uint8_t, kLargestSide * kLargestSide> is_hidden_;
  std::unique_ptr<DiscCells> cells_;
};

}  // namespace helical
