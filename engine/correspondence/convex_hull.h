#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

namespace helical {

/// Largest number of points `convexHull` takes: all centroids of a frame.
inline constexpr int kMaxHullPoints = 32;

/// Indices of a convex hull's strict vertices, in order.
struct HullOrder {
  std::array<std::uint8_t, kMaxHullPoints> index{};
  int count = 0;
};

/// Strict convex hull by Andrew's monotone chain, turning from +x to +y: counter-clockwise where y points up,
/// clockwise on an image, where it points down. Allocates nothing.
HullOrder convexHull(std::span<const Eigen::Vector2d> points);

}  // namespace helical
