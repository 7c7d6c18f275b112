#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/cameras/frame.h"

namespace helical {

/// How the values of a cell lie in memory. A cell is what is or is not a marker's: a pixel, or a 2x2 quad of
/// a Bayer image, whose colour is its red, its blue and the rounded mean of its greens.
enum class CellLayout : std::uint8_t {
  kBytes,             ///< one brightness
  kTriples,           ///< three bytes, green in the middle
  kQuadsColourFirst,  ///< colour, green / green, colour
  kQuadsGreenFirst    ///< green, colour / colour, green
};

/// An image as a grid of cells. The odd last row or column of a Bayer image belongs to no cell.
struct CellGrid {
  CellGrid() = default;
  explicit CellGrid(const ImageView& image);

  const std::uint8_t* row(int y) const { return data + static_cast<std::ptrdiff_t>(y) * stride; }
  /// Bytes of a row's cells; of a quad, in each of its two rows.
  int bytesPerCell() const;
  bool hasQuads() const {
    return layout == CellLayout::kQuadsColourFirst || layout == CellLayout::kQuadsGreenFirst;
  }

  const std::uint8_t* data = nullptr;
  std::ptrdiff_t stride = 0;      ///< bytes from a row of cells to the next
  std::ptrdiff_t second_row = 0;  ///< bytes from a quad's first row to its second
  int width = 0;
  int height = 0;
  CellLayout layout = CellLayout::kTriples;
  bool red_first = false;  ///< the first colour in memory is red, not blue
};

/// Brightness of a cell, or its first colour, green and last colour, in memory's order.
void readCell(const CellGrid& grid, int x, int y, std::uint8_t* values);

/// A cell's size in pixels, and the pixel position of cell (0, 0)'s centre.
inline double cellSize(const CellGrid& grid) {
  return grid.hasQuads() ? 2.0 : 1.0;
}
inline double cellOrigin(const CellGrid& grid) {
  return grid.hasQuads() ? 0.5 : 0.0;
}
/// An odd number of pixels as the nearest odd number of cells: of quads, 1 for 3 px, 3 for 5 and 7 px.
inline int sideInCells(int side_px, const CellGrid& grid) {
  return grid.hasQuads() ? side_px / 4 * 2 + 1 : side_px;
}

}  // namespace helical
