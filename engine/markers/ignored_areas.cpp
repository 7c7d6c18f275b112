#include "engine/markers/ignored_areas.h"

#include <algorithm>

namespace helical {

bool contains(const Polygon& polygon, const Eigen::Vector2d& pixel) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Eigen::Vector2d &a = polygon[i], &b = polygon[j];
    if ((a.y() > pixel.y()) == (b.y() > pixel.y())) continue;
    const double crossing = a.x() + (b.x() - a.x()) * (pixel.y() - a.y()) / (b.y() - a.y());
    if (pixel.x() < crossing) inside = !inside;
  }
  return inside;
}

bool isIgnored(const IgnoredAreas& areas, const Eigen::Vector2d& pixel) {
  return std::any_of(areas.begin(), areas.end(),
                     [&](const Polygon& polygon) { return contains(polygon, pixel); });
}

void fillMask(const IgnoredAreas& areas, const CellGrid& grid, BinaryMask& mask) {
  mask.resize(grid.width, grid.height);
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x)
      if (isIgnored(areas, Eigen::Vector2d::Constant(cellOrigin(grid)) +
                               cellSize(grid) * Eigen::Vector2d(x, y)))
        mask.row(y)[x / 64] |= std::uint64_t{1} << (x % 64);
}

}  // namespace helical
