#include "engine/markers/region_selection.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/rotation.h"

namespace helical {
namespace {

// Of fitted discs in rendered flights, with balls of 2.5 to 6.5 px: what the fit makes of its residuals is
// too little, more so where something hides a part; and the sampling of the outline, on as many cells as the
// radius and the ball's way are long, is in no residual. Squared errors over these covariances are 0.9
// to 1.3, of hidden balls up to 2.
constexpr double kWhole = 0.99;  ///< share of a disc
constexpr double kWholeScatter = 1.25;
constexpr double kHiddenScatter = 3.0;
constexpr double kOutlineVariance = 0.037 * 0.037;  ///< cells^3
/// Of the way of a ball that moves: no shutter, light or hand is as even as the model.
constexpr double kUnevenMotion = 0.002;

bool isBefore(const ColouredRegion& a, const ColouredRegion& b) {
  if (a.region.area != b.region.area) return a.region.area > b.region.area;
  if (a.region.sum_y != b.region.sum_y) return a.region.sum_y < b.region.sum_y;
  if (a.region.sum_x != b.region.sum_x) return a.region.sum_x < b.region.sum_x;
  return a.colour < b.colour;
}

}  // namespace

void RegionSelection::clear() {
  count_ = 0;
  found_ = 0;
}

void RegionSelection::add(std::span<const Region> regions, int colour, const CellGrid& grid) {
  const std::int64_t pixels = grid.hasQuads() ? 4 : 1;
  for (const Region& region : regions) {
    if (region.area * pixels < options_.minimum_area_px || region.area * pixels > options_.maximum_area_px)
      continue;
    ++found_;
    // A heap with the last of the kept ones on top.
    const ColouredRegion candidate{region, colour};
    if (count_ == kept_.size()) {
      if (!isBefore(candidate, kept_.front())) continue;
      std::pop_heap(kept_.begin(), kept_.end(), isBefore);
      --count_;
    }
    kept_[count_++] = candidate;
    std::push_heap(kept_.begin(), kept_.begin() + static_cast<std::ptrdiff_t>(count_), isBefore);
  }
}

std::span<const ColouredRegion> RegionSelection::sorted() {
  std::sort(kept_.begin(), kept_.begin() + static_cast<std::ptrdiff_t>(count_), isBefore);
  return {kept_.data(), count_};
}

Centroid binaryCentroid(const ColouredRegion& coloured, const CellGrid& grid, double sigma_px) {
  const Region& region = coloured.region;
  const auto area = static_cast<double>(region.area);
  const double size = cellSize(grid);
  Centroid centroid;
  centroid.pixel = {cellOrigin(grid) + size * (static_cast<double>(region.sum_x) / area),
                    cellOrigin(grid) + size * (static_cast<double>(region.sum_y) / area)};
  centroid.covariance = Eigen::Matrix2d::Identity() * (size * size * sigma_px * sigma_px);
  centroid.area_px = area * size * size;
  centroid.radius_px = std::sqrt(centroid.area_px / kPi);
  centroid.colour = coloured.colour;
  return centroid;
}

Centroid discCentroid(const ColouredRegion& coloured, const Disc& disc, const CellGrid& grid) {
  const double size = cellSize(grid);
  Centroid centroid;
  centroid.pixel = Eigen::Vector2d::Constant(cellOrigin(grid)) + size * disc.centre;
  centroid.radius_px = size * disc.radius;
  const double way = 2.0 * disc.half_way.norm();
  const Eigen::Vector2d uneven = 2.0 * kUnevenMotion * size * disc.half_way;
  const double fitted = disc.seen_share > kWhole ? kWholeScatter : kHiddenScatter;
  centroid.covariance = fitted * size * size * disc.covariance +
                        kOutlineVariance / (disc.radius + way) * size * size * Eigen::Matrix2d::Identity() +
                        uneven * uneven.transpose();
  centroid.area_px = disc.seen_share * kPi * centroid.radius_px * centroid.radius_px;
  centroid.colour = coloured.colour;
  return centroid;
}

}  // namespace helical
