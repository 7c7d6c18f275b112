#include "engine/markers/background_ranges.h"

#include <algorithm>

#include "engine/markers/background_kernels.h"

namespace helical {

void CellRange::include(const CellRange& other) {
  for (std::size_t i = 0; i < low.size(); ++i) {
    low[i] = std::min(low[i], other.low[i]);
    high[i] = std::max(high[i], other.high[i]);
  }
}

void BackgroundRanges::resize(const CellGrid& grid) {
  words_ = (grid.width + 63) / 64;
  const auto words = static_cast<std::size_t>(words_);
  const auto rows = static_cast<std::size_t>((grid.height + kTileRows - 1) / kTileRows);
  tiles_.assign(words * rows, {});
  row_.assign(words, {});
  renewed_.assign(words, {});
  next_renewed_ = 0;
}

void BackgroundRanges::measure(const CellGrid& grid) {
  resize(grid);
  for (int y = 0; y < grid.height; ++y) includeRow(grid, y, tiles_.data() + y / kTileRows * words_);
}

void BackgroundRanges::follow(const CellGrid& grid, int y) {
  std::fill(row_.begin(), row_.end(), CellRange{});
  includeRow(grid, y, row_.data());
  CellRange* tiles = tiles_.data() + y / kTileRows * words_;
  if (y % kTileRows == 0) {
    std::fill(renewed_.begin(), renewed_.end(), CellRange{});
    next_renewed_ = y;
  }
  // A quad's row changes twice in turn.
  const bool in_turn = next_renewed_ == y || next_renewed_ == y + 1;
  for (std::size_t w = 0; w < row_.size(); ++w) {
    tiles[w].include(row_[w]);
    if (in_turn) renewed_[w].include(row_[w]);
  }
  if (!in_turn) return;
  next_renewed_ = y + 1;
  if (next_renewed_ % kTileRows == 0 || next_renewed_ == grid.height)
    std::copy(renewed_.begin(), renewed_.end(), tiles);
}

}  // namespace helical
