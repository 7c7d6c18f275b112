#include "ui/camera_track_history.h"

#include <algorithm>
#include <cstdlib>

namespace helical {
namespace {

constexpr TimeNs kFarthest = 50 * kNanosecondsPerMillisecond;

}  // namespace

void CameraTrackHistory::add(const CameraTrack& track) {
  const CameraTrack* last = newest();
  if (track.exposure == 0 || (last != nullptr && last->exposure == track.exposure)) return;
  if (last != nullptr && track.exposure < last->exposure) count_ = 0;  // a recording was wound back
  tracks_[count_++ % kLength] = track;
}

const CameraTrack* CameraTrackHistory::at(TimeNs exposure) const {
  const auto end = tracks_.begin() + static_cast<std::ptrdiff_t>(std::min(count_, kLength));
  const auto nearest = std::min_element(tracks_.begin(), end, [exposure](const auto& a, const auto& b) {
    return std::abs(a.exposure - exposure) < std::abs(b.exposure - exposure);
  });
  if (nearest == end || std::abs(nearest->exposure - exposure) > kFarthest) return nullptr;
  return &*nearest;
}

const CameraTrack* CameraTrackHistory::newest() const {
  return count_ == 0 ? nullptr : &tracks_[(count_ - 1) % kLength];
}

}  // namespace helical
