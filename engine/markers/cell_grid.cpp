#include "engine/markers/cell_grid.h"

#include <algorithm>

namespace helical {
namespace {

CellLayout layoutOf(PixelFormat format) {
  switch (format) {
    case PixelFormat::kMono8:
      return CellLayout::kBytes;
    case PixelFormat::kBgr8:
    case PixelFormat::kRgb8:
      return CellLayout::kTriples;
    case PixelFormat::kBayerRg8:
    case PixelFormat::kBayerBg8:
      return CellLayout::kQuadsColourFirst;
    case PixelFormat::kBayerGr8:
    case PixelFormat::kBayerGb8:
      return CellLayout::kQuadsGreenFirst;
  }
  return CellLayout::kBytes;
}

}  // namespace

CellGrid::CellGrid(const ImageView& image)
    : data(image.data),
      stride(image.stride),
      width(image.width),
      height(image.height),
      layout(layoutOf(image.format)),
      red_first(image.format == PixelFormat::kRgb8 || image.format == PixelFormat::kBayerRg8 ||
                image.format == PixelFormat::kBayerGr8) {
  if (!hasQuads()) return;
  second_row = stride;
  stride *= 2;
  width /= 2;
  height /= 2;
}

int CellGrid::bytesPerCell() const {
  if (layout == CellLayout::kBytes) return 1;
  return layout == CellLayout::kTriples ? 3 : 2;
}

void readCell(const CellGrid& grid, int x, int y, std::uint8_t* values) {
  const std::uint8_t* cell = grid.row(y) + static_cast<std::ptrdiff_t>(x) * grid.bytesPerCell();
  if (!grid.hasQuads()) {
    std::copy_n(cell, grid.bytesPerCell(), values);
    return;
  }
  const std::uint8_t* below = cell + grid.second_row;
  const int green = grid.layout == CellLayout::kQuadsGreenFirst ? 0 : 1;
  values[0] = cell[1 - green];
  values[1] = static_cast<std::uint8_t>((cell[green] + below[1 - green] + 1) / 2);
  values[2] = below[green];
}

}  // namespace helical
