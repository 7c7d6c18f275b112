#pragma once

#include <array>
#include <span>

#include "engine/markers/ball_prediction.h"
#include "engine/markers/cell_grid.h"
#include "engine/markers/region_selection.h"

namespace helical {

/// The parts of an image that are read when it is known where the balls should be, and the verdict on what
/// was found there: whether reading everything could find more of these balls. One thread.
class SearchWindows {
 public:
  /// `border`: cells around a region that decide about it, by opening and closing.
  explicit SearchWindows(int border) : border_(border) {}

  /// False if the predictions say nothing about a frame of that exposure.
  bool place(const BallPredictions& predictions, TimeNs exposure, const CellGrid& grid);
  /// They do not overlap.
  std::span<const WordRect> windows() const { return {windows_.data(), static_cast<std::size_t>(count_)}; }

  /// Whether each ball that should be in the image has a region of its own where it may be, and no region
  /// reaches a window's edge, beyond which it would go on.
  bool hold(std::span<const ColouredRegion> regions) const;

 private:
  struct Target {
    double x, y, reach;  ///< cells
  };
  void add(WordRect window);
  bool isInside(const Region& region) const;

  int border_;
  int width_ = 0, height_ = 0;
  std::array<WordRect, kMaxMarkers> windows_;
  int count_ = 0;
  std::array<Target, kMaxMarkers> targets_;
  int target_count_ = 0;
};

}  // namespace helical
