#pragma once

#include <array>
#include <optional>
#include <vector>

#include "engine/markers/ball_outline.h"
#include "engine/markers/region_labeller.h"

namespace helical {

/// Values around a region, row after row; `level` lies half-way between a ball's and what is around it.
struct ValueWindow {
  const float* values = nullptr;
  int width = 0;
  int height = 0;
  float level = 0.0F;     ///< between that of the ball and that of what is around it
  float contrast = 0.0F;  ///< from there to the ball's

  bool isInside(int x, int y) const {
    return x >= 0 && y >= 0 && x < width && y < height && values[y * width + x] > level;
  }
};

/// Two balls of one colour that touch or overlap in the image are one region. They are told apart by their
/// outline: two circles of similar size that together explain it, are both full, leave nothing over, and
/// between which it has a waist on both sides, which a ball smeared by its motion has not. Everything is
/// counted from the window's corner on, in cells. Repeats bit for bit. Allocates in the constructor only. One
/// thread.
class OverlapSplit {
 public:
  OverlapSplit();

  /// By their shape alone, most regions are no two balls.
  static bool mayBeTwo(const Region& region);

  std::optional<std::array<OutlineCircle, 2>> circles(const ValueWindow& window);
  /// The window's inner cells that are nearer to the first circle's edge than to the second's, as a region.
  static Region partOf(const ValueWindow& window, const OutlineCircle& mine, const OutlineCircle& other);

 private:
  void collectOutline(const ValueWindow& window);
  std::optional<OutlineCircle> largestGroup(double least_radius, double most_radius) const;
  std::size_t removeOn(const OutlineCircle& circle);

  std::vector<OutlinePoint> outline_;
};

}  // namespace helical
