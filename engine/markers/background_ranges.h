#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/markers/cell_grid.h"

namespace helical {

/// Least and largest values of some cells, by channel in memory's order: brightness alone has the first.
struct CellRange {
  std::array<std::uint8_t, 4> low{255, 255, 255, 255};
  std::array<std::uint8_t, 4> high{0, 0, 0, 0};

  void include(const CellRange& other);
};

/// What is known of a background without reading it: the ranges of its cells in tiles of 64 x 8, in a sixtieth
/// of its memory or less. A marker's cell mostly lies outside of them by more than the threshold and
/// the background need not be read there. Allocates when a size is first seen. One thread.
class BackgroundRanges {
 public:
  static constexpr int kTileRows = 8;

  /// Room for cells of which nothing is known yet.
  void resize(const CellGrid& grid);
  void measure(const CellGrid& grid);
  /// This row of cells has changed. The ranges hold at once; where all rows of a tile have changed in turn,
  /// from the first to the last, they are as narrow as after `measure` again.
  void follow(const CellGrid& grid, int y);

  /// Tile after tile of a row of them, then those of the next row.
  const CellRange* tiles() const { return tiles_.data(); }

 private:
  int words_ = 0;
  std::vector<CellRange> tiles_;
  std::vector<CellRange> row_;      ///< of one row of cells
  std::vector<CellRange> renewed_;  ///< of the rows of a tile that have changed in turn
  int next_renewed_ = 0;            ///< the row that goes on with them
};

/// The image of the empty field.
struct BackgroundCells : CellGrid {
  BackgroundCells() = default;
  explicit BackgroundCells(const CellGrid& grid, const BackgroundRanges* ranges = nullptr)
      : CellGrid(grid), tiles(ranges != nullptr ? ranges->tiles() : nullptr) {}

  /// The range of a word's tile; only where ranges are known.
  const CellRange& range(int y, int word) const {
    return tiles[y / BackgroundRanges::kTileRows * ((width + 63) / 64) + word];
  }

  const CellRange* tiles = nullptr;  ///< null: not known
};

}  // namespace helical
