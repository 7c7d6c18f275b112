#pragma once

#include <memory>

#include "engine/transmitter/shared_output.h"
#include "engine/transmitter/transmitter.h"

namespace helical {

/// The device that the output process drives. Throws Error(kInput) for an unknown one, Error(kDevice) for one
/// that is not there.
std::unique_ptr<Transmitter> openOutputDevice(const OutputSettings& settings);

}  // namespace helical
