#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <span>

#include "engine/markers/ball_outline.h"
#include "engine/markers/cell_grid.h"
#include "engine/markers/disc_kernels.h"
#include "engine/markers/overlap_split.h"
#include "engine/markers/region_labeller.h"

namespace helical {

inline constexpr int kOutlineRays = 24;

/// The cells around a region that may be a ball, read once: their part along the ball's own colour, so that
/// grey surroundings, whatever their brightness, look alike, and their brightness. Everything is counted from
/// the window's corner on, in cells. Repeats bit for bit. Allocates in the constructor only. One thread.
struct BallWindow {
  static constexpr int kLargestSide = 88;

  BallWindow();

  /// False if the region is too large for it, or next to nothing.
  bool read(const CellGrid& grid, const Region& of);
  Eigen::Vector2d corner() const { return {left, top}; }
  /// All of it, with the level between the ball and what is around it.
  ValueWindow values();
  /// 0 for a cell that is the neighbour's.
  float givenAt(double x, double y) const;
  std::size_t placeOf(std::size_t cell) const;
  /// The points at that level on rays from the region's centre of gravity; how many there are.
  int traceOutline(double level, std::span<OutlinePoint> outline) const;
  /// Standard deviation of the residuals, which must have been evaluated: of these cells, and of those that
  /// the disc does not cover.
  float residualScale(const DiscCells& cells);
  float noiseAround();
  /// Cells beside a marked one are no longer given.
  void leaveOutMarked(DiscCells& cells);

  int left = 0, top = 0;  ///< of the window, in the image
  int width = 0, height = 0;
  Region region;                           ///< in the image
  OutlineCircle binary{};                  ///< the disc of the region's area at its centre of gravity
  std::optional<OutlineCircle> neighbour;  ///< in the image; another ball, whose cells are not given
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  ///< of the colours, along which values are taken
  bool has_colour = false;
  std::size_t real_count = 0;  ///< of the cells, without what only fills up
  std::unique_ptr<DiscCells> colour;
  std::unique_ptr<DiscCells> brightness;  ///< values only, until somebody sets the rest
  std::array<std::uint8_t, kLargestSide * kLargestSide> is_marked{};  ///< by place: does not fit
  std::array<float, kDiscCells> sorted{};                             ///< room for a median

 private:
  Eigen::Vector3d colourAxis(const CellGrid& grid) const;
  double valueAt(double x, double y) const;

  std::array<float, kLargestSide * kLargestSide> values_{};
};

/// Sorts some of them.
float medianOf(std::span<float> values);

}  // namespace helical
