#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "engine/base/time.h"

namespace helical {

/// By which the cameras of a rig know that an action is meant for them.
inline constexpr std::uint32_t kActionDeviceKey = 0x48656c69;
inline constexpr std::uint32_t kActionGroupKey = 1;
inline constexpr std::uint32_t kActionGroupMask = 1;

/// Tells a GigE Vision camera to act: at once, or when its clock reads `when`, which it must support and which makes
/// sense where PTP keeps the cameras' clocks together. Costs one datagram, waits for no answer.
void sendAction(const std::string& ip, std::optional<TimeNs> when);

}  // namespace helical
