#include "engine/markers/search_windows.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace helical {
namespace {

constexpr TimeNs kOldest = 60 * kNanosecondsPerMillisecond;
constexpr int kWordCells = 64;

}  // namespace

bool SearchWindows::place(const BallPredictions& predictions, TimeNs exposure, const CellGrid& grid) {
  count_ = target_count_ = 0;
  if (predictions.count == 0 || std::abs(exposure - predictions.time) > kOldest) return false;
  width_ = grid.width;
  height_ = grid.height;
  const double seconds = toSeconds(exposure - predictions.time), size = cellSize(grid);
  for (int i = 0; i < predictions.count; ++i) {
    const PredictedBall& ball = predictions.balls[static_cast<std::size_t>(i)];
    const Eigen::Vector2d at =
        (ball.pixel + seconds * ball.velocity - Eigen::Vector2d::Constant(cellOrigin(grid))) / size;
    const double reach = (ball.reach_px + std::abs(seconds) * ball.reach_rate_px_s) / size;
    const double half = reach + ball.radius_px / size + border_ + 1.0;
    // Also keeps the conversions below from overflowing.
    if (!(at.cwiseAbs().maxCoeff() < 1e6 && half < 1e6)) return false;
    if (ball.whole) targets_[static_cast<std::size_t>(target_count_++)] = {at.x(), at.y(), reach};
    add({static_cast<int>(std::floor(at.y() - half)), static_cast<int>(std::ceil(at.y() + half)),
         static_cast<int>(std::floor((at.x() - half) / kWordCells)),
         static_cast<int>(std::floor((at.x() + half) / kWordCells))});
  }
  return target_count_ > 0;
}

void SearchWindows::add(WordRect window) {
  window = {std::max(0, window.top), std::min(height_ - 1, window.bottom), std::max(0, window.left),
            std::min((width_ - 1) / kWordCells, window.right)};
  if (window.isEmpty()) return;
  for (int i = 0; i < count_;) {
    const auto k = static_cast<std::size_t>(i);
    if (!window.overlaps(windows_[k])) {
      ++i;
      continue;
    }
    window.include(windows_[k]);
    windows_[k] = windows_[static_cast<std::size_t>(--count_)];
    i = 0;
  }
  windows_[static_cast<std::size_t>(count_++)] = window;
}

bool SearchWindows::hold(std::span<const ColouredRegion> regions) const {
  std::array<bool, kMaxCentroids> is_taken{};
  for (std::size_t t = 0; t < static_cast<std::size_t>(target_count_); ++t) {
    const Target& target = targets_[t];
    double nearest = target.reach * target.reach;
    std::size_t best = regions.size();
    for (std::size_t r = 0; r < regions.size(); ++r) {
      const Region& region = regions[r].region;
      const auto area = static_cast<double>(region.area);
      const double dx = static_cast<double>(region.sum_x) / area - target.x,
                   dy = static_cast<double>(region.sum_y) / area - target.y;
      if (is_taken[r] || dx * dx + dy * dy > nearest) continue;
      nearest = dx * dx + dy * dy;
      best = r;
    }
    if (best == regions.size()) return false;
    is_taken[best] = true;
  }
  return std::all_of(regions.begin(), regions.end(),
                     [this](const ColouredRegion& region) { return isInside(region.region); });
}

bool SearchWindows::isInside(const Region& region) const {
  const auto all = windows();
  return std::any_of(all.begin(), all.end(), [&](const WordRect& window) {
    const int left = kWordCells * window.left, right = kWordCells * window.right + kWordCells - 1;
    return (window.top == 0 || region.top - border_ >= window.top) &&
           (window.bottom == height_ - 1 || region.bottom + border_ <= window.bottom) &&
           (left == 0 || region.left - border_ >= left) &&
           (right >= width_ - 1 || region.right + border_ <= right);
  });
}

}  // namespace helical
