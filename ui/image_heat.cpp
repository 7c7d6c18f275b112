#include "ui/image_heat.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace helical {

void ImageHeat::add(const CameraTrack& track, int marker_count) {
  if (track.exposure <= newest_) return;
  newest_ = track.exposure;
  for (int i = 0; i < marker_count; ++i) {
    const MarkerTrack& marker = track.markers[static_cast<std::size_t>(i)];
    if (!marker.selected || !marker.predicted) continue;
    const int column = static_cast<int>((marker.pixel.x() + 0.5) / sensor_.width() * kColumns);
    const int row = static_cast<int>((marker.pixel.y() + 0.5) / sensor_.height() * kRows);
    if (column < 0 || column >= kColumns || row < 0 || row >= kRows) continue;
    Cell& cell = cells_[static_cast<std::size_t>(row * kColumns + column)];
    ++cell.count;
    cell.squares += (marker.pixel - marker.reprojected).squaredNorm();
  }
}

void ImageHeat::clear() {
  cells_.fill({});
}

QPointF ImageHeat::middle(int column, int row) const {
  return {(column + 0.5) * sensor_.width() / kColumns - 0.5, (row + 0.5) * sensor_.height() / kRows - 0.5};
}

int ImageHeat::largestCount() const {
  return std::max_element(cells_.begin(), cells_.end(),
                          [](const Cell& a, const Cell& b) { return a.count < b.count; })
      ->count;
}

double ImageHeat::residual(int column, int row) const {
  const Cell& seen = cell(column, row);
  return seen.count > 0 ? std::sqrt(seen.squares / seen.count) : std::numeric_limits<double>::quiet_NaN();
}

double ImageHeat::largestResidual() const {
  double largest = 0.0;
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column)
      if (count(column, row) > 0) largest = std::max(largest, residual(column, row));
  return largest;
}

double ImageHeat::covered() const {
  const auto seen =
      std::count_if(cells_.begin(), cells_.end(), [](const Cell& cell) { return cell.count > 0; });
  return static_cast<double>(seen) / static_cast<double>(cells_.size());
}

}  // namespace helical
