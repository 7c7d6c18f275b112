#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "engine/base/clock.h"
#include "engine/cameras/camera_link.h"
#include "engine/config/rig_config.h"
#include "engine/markers/extracting_source.h"
#include "engine/pipeline/snapshot.h"
#include "engine/pipeline/tampered_sources.h"
#include "engine/simulator/disturbances.h"
#include "engine/simulator/world.h"
#include "engine/transmitter/transmitter.h"

namespace helical {

/// What a rig file names, opened: one source per camera in the rig's order, and the transmitter. Real or
/// simulated; who uses it cannot tell, but for `world`, which only simulated rigs have and which serves
/// display and scoring alone.
struct RigHardware {
  std::vector<std::unique_ptr<ObservationSource>> sources;
  std::unique_ptr<Transmitter> transmitter;
  std::shared_ptr<World> world;
  std::vector<std::shared_ptr<TamperingChannel>> tampering;     ///< one per camera
  std::vector<std::shared_ptr<ExtractorOrders>> orders;         ///< one per camera
  std::vector<std::optional<CameraDisturbances>> disturbances;  ///< of simulated cameras: where they truly are
  std::vector<std::shared_ptr<CameraLink>> links;               ///< one per camera

  /// Adds the truth of a simulated rig to a snapshot taken at `now`; leaves that of a real one alone.
  void addTruth(EngineSnapshot& snapshot, TimeNs now) const;
  /// Adds how the cameras' devices stand to this machine.
  void addLinks(EngineSnapshot& snapshot) const;
};

/// Where a simulated camera truly is before anybody knocks it. Throws Error(kInput) when the rig does not
/// say.
RigidTransform trueCameraFromWorld(const RigConfig& rig, CameraId camera);

/// Opens every device of the rig. `tap` sees the frames of cameras that have images, on their capture
/// threads. In simulation the helicopter is carried about for `carried_s` before it stands on the pad. Throws
/// Error(kDevice) for what cannot be opened.
RigHardware openRig(const RigConfig& rig, std::shared_ptr<Clock> clock,
                    const ExtractingSource::FrameTap& tap = {}, double carried_s = 0.0);

}  // namespace helical
