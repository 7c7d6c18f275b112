#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/markers/binary_mask.h"
#include "engine/markers/marker_options.h"
#include "engine/markers/observation.h"

namespace helical {

/// One 8-connected region: its zeroth and first moments.
struct Region {
  std::int64_t area = 0;
  std::int64_t sum_x = 0;
  std::int64_t sum_y = 0;
};

/// 8-connected regions of a mask: runs of set pixels, joined by union-find. Its workspace has the size of the
/// worst case, so that only `resize` allocates.
class RegionLabeller {
 public:
  void resize(int width, int height);

  /// In no particular order; valid until the next call.
  std::span<Region> label(const BinaryMask& mask);

 private:
  struct Run {
    int first;
    int last;
    int label;
  };

  void findRuns(const BinaryMask& mask, int y);
  void joinRuns(int y);
  int rootOf(int label);
  int unite(int a, int b);

  std::vector<Run> above_;
  std::vector<Run> current_;
  std::vector<int> parents_;
  std::vector<Region> regions_;
};

/// Turns regions into the observation's centroids: those of a marker's size, largest first (then from top to
/// bottom, from left to right), at most kMaxCentroids. Reorders `regions`.
void fillCentroids(std::span<Region> regions, const MarkerOptions& options, Observation& observation);

}  // namespace helical
