#pragma once

#include <array>
#include <cstddef>

#include "engine/tracking/track.h"

namespace helical {

/// The newest tracks of one camera, so that a picture, which travels slower than numbers, is marked with what
/// the tracker made of that very frame. Used by the window's thread.
class CameraTrackHistory {
 public:
  /// Ignores a track it holds already.
  void add(const CameraTrack& track);
  /// The track of the frame exposed at `exposure`, else the nearest in time; nothing if that is over 50 ms
  /// away.
  const CameraTrack* at(TimeNs exposure) const;
  const CameraTrack* newest() const;
  /// Calls `with` for the tracks up to `exposure`, oldest first, the last `seconds` of them.
  template <class With>
  void forTrail(TimeNs exposure, double seconds, const With& with) const {
    const std::size_t held = count_ < kLength ? count_ : kLength;
    for (std::size_t i = count_ - held; i < count_; ++i) {
      const CameraTrack& track = tracks_[i % kLength];
      if (track.exposure <= exposure && track.exposure > exposure - fromSeconds(seconds)) with(track);
    }
  }

 private:
  static constexpr std::size_t kLength = 96;

  std::array<CameraTrack, kLength> tracks_{};
  std::size_t count_ = 0;  ///< ever added
};

}  // namespace helical
