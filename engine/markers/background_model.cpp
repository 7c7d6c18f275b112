#include "engine/markers/background_model.h"

#include <algorithm>

#include "engine/markers/background_kernels.h"

namespace helical {

int rowBytes(const ImageView& image) {
  return image.width * (image.format == PixelFormat::kBgr8 || image.format == PixelFormat::kRgb8 ? 3 : 1);
}

void BackgroundModel::take() {
  state_ = State::kTaking;
  taken_ = 0;
}

void BackgroundModel::set(const ImageView& image) {
  resize(image);
  const auto row_bytes = static_cast<std::size_t>(rowBytes(image));
  for (int y = 0; y < image.height; ++y)
    std::copy_n(image.row(y), row_bytes, mean_.data() + static_cast<std::size_t>(y) * row_bytes);
  ranges_.measure(CellGrid(view()));
  state_ = State::kReady;
}

void BackgroundModel::update(const ImageView& image) {
  if (state_ == State::kDisabled) return;
  if (!fits(image)) {
    resize(image);
    take();
  }
  if (state_ == State::kReady) return;
  accumulate(image);
  if (taken_ == frames_) average();
}

void BackgroundModel::adapt(const ImageView& image, int rows, int most, const KeptOut& kept_out) {
  if (state_ != State::kReady || !fits(image)) return;
  const int row_bytes = rowBytes(image), bytes = row_bytes / width_;
  const auto move = [&](int y, int from, int to) {
    if (from >= to) return;
    moveTowards(image.row(y) + from, static_cast<std::size_t>(to - from), static_cast<std::uint8_t>(most),
                mean_.data() + static_cast<std::ptrdiff_t>(y) * row_bytes + from);
  };
  for (int i = 0; i < std::min(rows, height_); ++i) {
    const int y = next_row_;
    next_row_ = (next_row_ + 1) % height_;
    if (y < kept_out.top || y > kept_out.bottom) {
      move(y, 0, row_bytes);
    } else {
      move(y, 0, bytes * std::clamp(kept_out.left, 0, width_));
      move(y, bytes * std::clamp(kept_out.right + 1, 0, width_), row_bytes);
    }
    followRow(y);
  }
}

void BackgroundModel::followRow(int y) {
  const CellGrid grid(view());
  const int rows_of_cell = grid.hasQuads() ? 2 : 1;
  if (y / rows_of_cell < grid.height) ranges_.follow(grid, y / rows_of_cell);
}

ImageView BackgroundModel::view() const {
  ImageView view{mean_.data(), width_, height_, 0, format_};
  view.stride = rowBytes(view);
  return view;
}

bool BackgroundModel::fits(const ImageView& image) const {
  return image.width == width_ && image.height == height_ && image.format == format_;
}

void BackgroundModel::resize(const ImageView& image) {
  width_ = image.width;
  height_ = image.height;
  format_ = image.format;
  next_row_ = 0;
  const auto bytes = static_cast<std::size_t>(rowBytes(image)) * static_cast<std::size_t>(height_);
  mean_.resize(bytes);
  sums_.resize(bytes);
  ranges_.resize(CellGrid(view()));
}

void BackgroundModel::accumulate(const ImageView& image) {
  if (taken_ == 0) std::fill(sums_.begin(), sums_.end(), 0U);
  const auto row_bytes = static_cast<std::size_t>(rowBytes(image));
  for (int y = 0; y < image.height; ++y) {
    const std::uint8_t* source = image.row(y);
    std::uint32_t* sum = sums_.data() + static_cast<std::size_t>(y) * row_bytes;
    for (std::size_t x = 0; x < row_bytes; ++x) sum[x] += source[x];
  }
  ++taken_;
}

void BackgroundModel::average() {
  const auto n = static_cast<std::uint32_t>(taken_);
  std::transform(sums_.begin(), sums_.end(), mean_.begin(),
                 [n](std::uint32_t sum) { return static_cast<std::uint8_t>((sum + n / 2) / n); });
  ranges_.measure(CellGrid(view()));
  state_ = State::kReady;
}

}  // namespace helical
