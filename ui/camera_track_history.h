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

 private:
  static constexpr std::size_t kLength = 32;

  std::array<CameraTrack, kLength> tracks_{};
  std::size_t count_ = 0;  ///< ever added
};

}  // namespace helical
