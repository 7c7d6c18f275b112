#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
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
  ValueWindow values() const { return {values_.data(), width, height, level_, contrast_}; }
  /// 0 for a cell that is the neighbour's.
  float givenAt(double x, double y) const;
  /// The points at that level on rays from the region's centre of gravity; how many there are.
  int traceOutline(double level, std::span<OutlinePoint> outline) const;
  /// That cell and those beside it, which what is before it hides in part, are no longer given.
  void leaveOut(std::size_t cell, DiscCells& cells) const;

  int left = 0, top = 0;  ///< of the window, in the image
  int width = 0, height = 0;
  Region region;                           ///< in the image
  OutlineCircle binary{};                  ///< the disc of the region's area at its centre of gravity
  std::optional<OutlineCircle> neighbour;  ///< in the image; another ball, whose cells are not given
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  ///< of the colours, along which values are taken
  bool has_colour = false;
  std::size_t real_count = 0;  ///< of the cells, without what only fills up
  std::unique_ptr<DiscCells> colour;
  std::unique_ptr<DiscCells> brightness;             ///< values only, until somebody sets the rest
  std::array<std::uint8_t, kDiscCells> is_marked{};  ///< cells that do not fit
  std::array<float, kDiscCells> room{};              ///< for medians

 private:
  void readValues(const CellGrid& grid);
  /// Adds the cells between two distances from the middle of the region's box.
  void addRing(double from, double to);
  void addCells(int y, int from, int to);
  Eigen::Vector3d colourAxis(const CellGrid& grid) const;
  void findLevels();
  double valueAt(double x, double y) const;

  std::array<float, kLargestSide * kLargestSide> values_{};
  std::array<float, kLargestSide * kLargestSide> brightness_{};
  std::array<std::int16_t, kLargestSide * kLargestSide> cell_at_{};  ///< by place; -1 where there is none
  float level_ = 0.0F, contrast_ = 0.0F;
};

}  // namespace helical
