#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/config/rig_config.h"
#include "engine/pipeline/snapshot.h"
#include "engine/session/mcap_reader.h"

namespace helical {

/// Finds the image that a camera showed at a time, by the file's index. One thread.
class PictureFinder {
 public:
  /// `session` must outlive this.
  PictureFinder(McapReader& session, const RigConfig& rig);

  bool hasImages(CameraId camera) const { return !ofCamera(camera).chunks.empty(); }

  /// The newest image that came from `oldest` to `newest` into `picture`, unless it is the one that came at
  /// `shown`. Returns when it came; -1 if there is none.
  TimeNs load(CameraId camera, TimeNs oldest, TimeNs newest, TimeNs shown, CameraPicture& picture);

 private:
  struct Images {
    std::uint16_t channel = 0;
    bool compressed = false;
    std::vector<std::size_t> chunks;
    std::vector<TimeNs> latest;  ///< end of each chunk and of all before
  };
  const Images& ofCamera(CameraId camera) const { return images_[static_cast<std::size_t>(camera.index())]; }

  McapReader& session_;
  std::array<Images, kMaxCameras> images_{};
};

/// A picture for an observation without one: a disc for each of its centroids.
void drawDiscs(const Observation& observation, int width, int height, CameraPicture& picture);

}  // namespace helical
