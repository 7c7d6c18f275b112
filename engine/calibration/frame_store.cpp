#include "engine/calibration/frame_store.h"

#include <algorithm>

namespace helical {

StoredFrame stored(const CalibrationFrame& frame) {
  StoredFrame copy;
  copy.world_from_body = frame.world_from_body;
  copy.pose_covariance = frame.pose_covariance;
  copy.count = std::min(static_cast<int>(frame.pixels.size()), kMaxMarkers);
  std::copy_n(frame.pixels.begin(), copy.count, copy.pixels.begin());
  return copy;
}

std::span<const StoredFrame* const> FrameStore::spread(std::span<const StoredFrame*> selection) const {
  const auto order = store_.frames();
  const std::size_t count = std::min(selection.size(), order.size());
  for (std::size_t i = 0; i < count; ++i) selection[i] = order[(i + 1) * order.size() / count - 1];
  return selection.first(count);
}

}  // namespace helical
