#pragma once

#include <memory>

#include "engine/transmitter/shared_output.h"
#include "engine/transmitter/transmitter.h"

namespace helical {

inline constexpr const char* kMccDevice = "mcc-usb-3100";
inline constexpr const char* kCrazyradioDevice = "crazyradio";

/// The device that the output process drives. A USB device may come later; its status says so. Throws Error(kInput) for
/// an unknown one, Error(kDevice) for one that cannot be had.
std::unique_ptr<Transmitter> openOutputDevice(const OutputSettings& settings);

}  // namespace helical
