#include "engine/correspondence/nested_polygons.h"

#include <algorithm>
#include <cmath>

#include "engine/base/check.h"
#include "engine/correspondence/convex_hull.h"

namespace helical {
namespace {

int largestLayer(const ConvexLayers& layers) {
  return layers.count == 0 ? 0 : *std::max_element(layers.size.begin(), layers.size.begin() + layers.count);
}

std::uint64_t labellingCount(const ConvexLayers& layout, const ConvexLayers& image) {
  if (layout.points == 0 || !sameShape(layout, image)) return 0;
  std::uint64_t product = 1;
  for (int b = 0; b < layout.count; ++b) product *= layout.size[static_cast<std::size_t>(b)];
  return product;
}

}  // namespace

ConvexLayers peelConvexLayers(std::span<const Eigen::Vector2d> points) {
  HELICAL_CHECK(points.size() <= kMaxMarkers);
  std::array<Eigen::Vector2d, kMaxMarkers> left;
  std::array<std::uint8_t, kMaxMarkers> name{};
  std::size_t remaining = points.size();
  std::copy(points.begin(), points.end(), left.begin());
  for (std::size_t i = 0; i < remaining; ++i) name[i] = static_cast<std::uint8_t>(i);

  ConvexLayers layers;
  layers.points = static_cast<int>(points.size());
  std::size_t filled = 0;
  while (remaining > 0) {
    const HullOrder hull = convexHull({left.data(), remaining});
    std::array<bool, kMaxMarkers> peeled{};
    for (int i = 0; i < hull.count; ++i) {
      const std::size_t vertex = hull.index[static_cast<std::size_t>(i)];
      layers.index[filled++] = name[vertex];
      peeled[vertex] = true;
    }
    layers.size[static_cast<std::size_t>(layers.count++)] = static_cast<std::uint8_t>(hull.count);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < remaining; ++i) {
      if (peeled[i]) continue;
      left[kept] = left[i];
      name[kept++] = name[i];
    }
    remaining = kept;
  }
  return layers;
}

bool sameShape(const ConvexLayers& a, const ConvexLayers& b) {
  return a.points == b.points && a.count == b.count &&
         std::equal(a.size.begin(), a.size.begin() + a.count, b.size.begin());
}

NestedLabellings::NestedLabellings(const ConvexLayers& layout, const ConvexLayers& image, ViewSide side)
    : layout_(layout),
      image_(image),
      reversed_(side != ViewSide::kBelow),
      // Layers below three points are the same either way round.
      other_side_to_come_(side == ViewSide::kEither && largestLayer(layout) >= 3),
      count_(labellingCount(layout, image) * (other_side_to_come_ ? 2 : 1)),
      more_(count_ > 0) {}

bool NestedLabellings::next(Labelling& labelling) {
  if (!more_) return false;
  labelling = {};
  labelling.count = image_.points;
  std::size_t first = 0;
  for (std::size_t b = 0; b < static_cast<std::size_t>(image_.count); ++b) {
    const std::size_t n = image_.size[b];
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t along = reversed_ ? n - i : i;
      labelling.marker[image_.index[first + i]] = layout_.index[first + (along + shift_[b]) % n];
    }
    first += n;
  }
  advance();
  return true;
}

void NestedLabellings::advance() {
  for (std::size_t b = 0; b < static_cast<std::size_t>(image_.count); ++b) {
    if (++shift_[b] < image_.size[b]) return;
    shift_[b] = 0;
  }
  more_ = other_side_to_come_;
  other_side_to_come_ = false;
  reversed_ = false;
}

double theoremOneBound(int markers) {
  return std::pow(3.0, markers / 3.0);
}

double fullSearchCount(int markers) {
  double product = 1.0;
  for (int i = 2; i <= markers; ++i) product *= i;
  return product;
}

}  // namespace helical
