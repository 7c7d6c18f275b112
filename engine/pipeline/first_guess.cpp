#include "engine/pipeline/first_guess.h"

#include "engine/pipeline/rig_hardware.h"
#include "engine/simulator/disturbances.h"
#include "engine/simulator/random_streams.h"

namespace helical {

void giveFirstGuesses(RigConfig& rig, double angle, double distance, std::uint64_t seed, bool replace) {
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    CameraConfig& camera = rig.cameras[i];
    if (camera.camera_from_world && !(camera.pose_is_guess && replace)) continue;
    const CameraId id = cameraId(static_cast<int>(i));
    camera.camera_from_world = displaced(trueCameraFromWorld(rig, id), angle, distance,
                                         randomStream(seed, RandomStream::kFirstGuesses, id));
    camera.pose_is_guess = true;
  }
}

}  // namespace helical
