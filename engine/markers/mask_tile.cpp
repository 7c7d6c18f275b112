#include "engine/markers/mask_tile.h"

#include <algorithm>
#include <utility>

#include "engine/markers/mask_kernels.h"

namespace helical {
namespace {

constexpr std::uint64_t kEvery = ~std::uint64_t{0};

std::ptrdiff_t roundedUp(int rows) {
  return (rows + 7) / 8 * 8;
}

}  // namespace

void MaskTile::resize(int width, int height) {
  image_words_ = (width + 63) / 64;
  image_height_ = height;
  outside_ = width % 64 == 0 ? 0 : kEvery << (width % 64);
  const auto room = static_cast<std::size_t>(image_words_ * (roundedUp(height) + 2 * kPadding));
  a_.assign(room, 0);
  b_.assign(room, 0);
}

void MaskTile::place(const WordRect& rect) {
  rect_ = rect;
  stride_ = roundedUp(rows()) + 2 * kPadding;
}

void MaskTile::open(int reach) {
  if (reach == 0) return;
  erode(reach);
  dilate(reach);
}

void MaskTile::close(int reach) {
  if (reach == 0) return;
  dilate(reach);
  erode(reach);
}

void MaskTile::erode(int reach) {
  pad(reach, rect_.top == 0 ? kEvery : 0, rect_.bottom == image_height_ - 1 ? kEvery : 0);
  advance(true, reach);
}

void MaskTile::dilate(int reach) {
  pad(reach, 0, 0);
  advance(false, reach);
}

void MaskTile::pad(int reach, std::uint64_t above, std::uint64_t below) {
  for (int word = rect_.left; word <= rect_.right; ++word) {
    std::fill_n(column(word) - reach, reach, above);
    std::fill_n(column(word) + rows(), reach, below);
  }
}

void MaskTile::advance(bool erode, int reach) {
  const bool at_right = rect_.right == image_words_ - 1;
  MaskStep step;
  step.in = column(rect_.left);
  step.out = next_->data() + kPadding;
  step.stride = stride_;
  step.rows = rows();
  step.columns = columns();
  step.reach = reach;
  step.outside = at_right ? outside_ : 0;
  if (erode) {
    step.before = rect_.left == 0 ? kEvery : 0;
    step.after = at_right ? kEvery : 0;
    erodeColumns(step);
  } else {
    dilateColumns(step);
  }
  std::swap(now_, next_);
}

}  // namespace helical
