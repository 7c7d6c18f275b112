#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/markers/mask_tile.h"

namespace helical {

/// One 8-connected region: its zeroth and first moments and its box, in cells.
struct Region {
  std::int64_t area = 0;
  std::int64_t sum_x = 0;
  std::int64_t sum_y = 0;
  int left = 0;
  int top = 0;
  int right = -1;
  int bottom = -1;
};

/// 8-connected regions of masks: runs of set cells, joined by union-find. Its workspace has the size of the
/// worst case, so that only `resize` allocates. One thread.
class RegionLabeller {
 public:
  void resize(int width, int height);

  /// Forgets all regions.
  void clear();
  /// Adds those of a part of the mask; parts must not touch each other. `changes`, if given, are the part's.
  void label(const MaskTile& part, std::span<const std::uint64_t> changes = {});
  /// All of them, in no particular order; valid until the next call of another function.
  std::span<Region> regions();

 private:
  struct Run {
    int first;
    int last;
    int label;
  };

  void findRuns(const MaskTile& part, int y);
  void joinRuns(int y);
  void repeatRuns(int y, int rows);
  int rootOf(int label);
  int unite(int a, int b);

  std::vector<Run> above_;
  std::vector<Run> current_;
  std::vector<int> parents_;
  std::vector<Region> regions_;
};

}  // namespace helical
