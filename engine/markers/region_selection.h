#pragma once

#include <array>
#include <span>

#include "engine/markers/cell_grid.h"
#include "engine/markers/disc_fit.h"
#include "engine/markers/marker_options.h"
#include "engine/markers/observation.h"
#include "engine/markers/region_labeller.h"

namespace helical {

/// A region and which of the options' colours it has.
struct ColouredRegion {
  Region region;
  int colour = 0;
};

/// Picks from all regions of a frame those that are kept: of a marker's size, largest first (then from top to
/// bottom, from left to right), at most kMaxCentroids. One thread.
class RegionSelection {
 public:
  explicit RegionSelection(const MarkerOptions& options) : options_(options) {}

  void clear();
  void add(std::span<const Region> regions, int colour, const CellGrid& grid);
  /// Sorted; valid until the next call.
  std::span<const ColouredRegion> sorted();
  /// Whether there were more than can be kept.
  bool truncated() const { return found_ > kMaxCentroids; }

 private:
  const MarkerOptions& options_;
  std::array<ColouredRegion, kMaxCentroids> kept_;
  std::size_t count_ = 0;
  int found_ = 0;
};

/// The centre of gravity of a region's cells.
Centroid binaryCentroid(const ColouredRegion& region, const CellGrid& grid, double sigma_px);

/// The centre of the disc that was fitted to a region, with the covariance that such centres have.
Centroid discCentroid(const ColouredRegion& region, const Disc& disc, const CellGrid& grid);

}  // namespace helical
