#pragma once

#include <memory>

#include "engine/base/clock.h"
#include "engine/cameras/camera_link.h"
#include "engine/cameras/camera_source.h"
#include "engine/config/rig_config.h"
#include "engine/simulator/world.h"
#include "engine/transmitter/transmitter.h"

namespace helical {

/// Whether the rig has cameras or a transmitter that live in real time: it cannot be flown in lock step.
bool needsRealTime(const RigConfig& rig);

/// Whether every camera of the rig is a recording: it looks on until they end.
bool isOfRecordings(const RigConfig& rig);

/// The camera's device or file, opened and streaming. Throws Error(kDevice) when it is not there, Error(kInput) when it
/// does not offer what the rig asks for.
std::unique_ptr<CameraSource> openDevice(const RigConfig& rig, CameraId camera, std::shared_ptr<Clock> clock,
                                         std::shared_ptr<CameraLink> link);

/// `world`: of the rig's simulated cameras; null without any.
std::unique_ptr<Transmitter> openTransmitter(const RigConfig& rig, const std::shared_ptr<World>& world);

}  // namespace helical
