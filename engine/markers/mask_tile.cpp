#include "engine/markers/mask_tile.h"

#include <algorithm>
#include <utility>

namespace helical {
namespace {

constexpr std::uint64_t kEvery = ~std::uint64_t{0};

/// Rows of a vector, the most that a step writes at once.
constexpr int kGroup = 8;

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
  by_row_.assign(static_cast<std::size_t>(roundedUp(height)), 0);
}

void MaskTile::place(const WordRect& rect) {
  rect_ = rect;
  first_row_ = 0;
  end_row_ = rows();
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

void MaskTile::openAndCloseFull(int opening, int closing) {
  mergeRows(step(), by_row_.data());
  const auto isFull = [this](int row) {
    const auto begin = by_row_.begin() + row;
    return std::all_of(begin, begin + std::min(kGroup, rows() - row),
                       [](std::uint64_t all) { return all == kEvery; });
  };
  // What is unset reaches a group further at most.
  const auto mayChange = [&](int row) {
    for (int near = std::max(0, row - kGroup); near < std::min(rows(), row + 2 * kGroup); near += kGroup)
      if (!isFull(near)) return true;
    return false;
  };
  for (int row = 0; row < rows(); row = end_row_ + kGroup) {
    first_row_ = end_row_ = row;
    while (end_row_ < rows() && mayChange(end_row_)) end_row_ += kGroup;
    end_row_ = std::min(end_row_, rows());
    if (end_row_ == first_row_) continue;
    open(opening);
    close(closing);
  }
  first_row_ = 0;
  end_row_ = rows();
}

std::span<const std::uint64_t> MaskTile::changes() {
  compareRows(step(), by_row_.data());
  return {by_row_.data(), static_cast<std::size_t>(rows())};
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
  if (first_row_ > 0) above = kEvery;
  if (end_row_ < rows()) below = kEvery;
  for (int word = rect_.left; word <= rect_.right; ++word) {
    const std::uint64_t inside = word == rect_.right && isAtRight() ? ~outside_ : kEvery;
    std::fill_n(column(word) + first_row_ - reach, reach, above & inside);
    std::fill_n(column(word) + end_row_, reach, below & inside);
  }
}

MaskStep MaskTile::step() const {
  MaskStep step;
  step.in = column(rect_.left) + first_row_;
  step.stride = stride_;
  step.rows = end_row_ - first_row_;
  step.columns = columns();
  step.outside = isAtRight() ? outside_ : 0;
  return step;
}

void MaskTile::advance(bool erode, int reach) {
  MaskStep step = this->step();
  step.out = next_->data() + kPadding + first_row_;
  step.reach = reach;
  if (erode) {
    step.before = rect_.left == 0 ? kEvery : 0;
    step.after = isAtRight() ? kEvery : 0;
    erodeColumns(step);
  } else {
    dilateColumns(step);
  }
  std::swap(now_, next_);
}

}  // namespace helical
