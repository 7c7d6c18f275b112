#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "engine/base/ids.h"

namespace helical {

/// Points sorted into nested convex polygons, outermost first (the paper's III.B, steps 1 to 4; Chazelle 1985
/// calls them convex layers). A last layer of one or two points is left over inside. Where all that remains
/// lies on one line, a layer is that line's two ends.
struct ConvexLayers {
  std::array<std::uint8_t, kMaxMarkers> index{};  ///< of the points, layer after layer, each in hull order
  std::array<std::uint8_t, kMaxMarkers> size{};   ///< of each layer
  int count = 0;                                  ///< layers
  int points = 0;
};

/// Peels strict hulls (see convexHull for their direction) off up to kMaxMarkers points. Allocates nothing.
ConvexLayers peelConvexLayers(std::span<const Eigen::Vector2d> points);

/// Whether the layers have equal sizes one by one: without it no labelling is consistent, as when noise moves
/// a point over an edge of a hull.
bool sameShape(const ConvexLayers& a, const ConvexLayers& b);

/// From where a camera sees the plane of the markers. Seen from above the body's x-y plane is mirrored in the
/// image, whose v axis points down: hull order is reversed there.
enum class ViewSide {
  kAbove,
  kBelow,
  kEither,  ///< both orders are tried
};

/// The marker of each centroid.
struct Labelling {
  std::array<std::uint8_t, kMaxMarkers> marker{};  ///< by centroid
  int count = 0;

  bool operator==(const Labelling&) const = default;
};

/// All labellings that keep nested polygons: the product of the cyclic shifts of every layer (step 5). A
/// left-over layer has r! of them, which are cyclic shifts as well, r being below 3. One after the other,
/// without storing them. Allocates nothing.
class NestedLabellings {
 public:
  NestedLabellings(const ConvexLayers& layout, const ConvexLayers& image, ViewSide side);

  /// How many there are; 0 when the layers differ in shape.
  std::uint64_t count() const { return count_; }

  /// The next one; false after the last.
  bool next(Labelling& labelling);

 private:
  void advance();

  ConvexLayers layout_;
  ConvexLayers image_;
  std::array<std::uint8_t, kMaxMarkers> shift_{};
  bool reversed_;
  bool other_side_to_come_;
  std::uint64_t count_;
  bool more_;
};

/// Theorem 1: no more than 3^(N/3) labellings of one view's side. The proof in the paper has C <= N/3
/// polygons, which a left-over layer breaks; the bound stands all the same, as n <= 3^(n/3) for each layer of
/// n >= 1 points.
double theoremOneBound(int markers);

/// N!, the labellings of a full search.
double fullSearchCount(int markers);

}  // namespace helical
