#pragma once

#include <cstdint>

#include "engine/flight/supervisor.h"

namespace helical {

/// Every check that fails, as bits of PreArmCheck; 0: it may arm. A pure function.
std::uint32_t failingChecks(const SupervisorOptions& options, SafetyState state,
                            const SupervisorConditions& conditions);

/// Those of them that are about where and how the helicopter stands.
inline constexpr std::uint32_t kStandingChecks = bitOf(PreArmCheck::kPose) | bitOf(PreArmCheck::kPad) |
                                                 bitOf(PreArmCheck::kUpright) | bitOf(PreArmCheck::kStill) |
                                                 bitOf(PreArmCheck::kFence) | bitOf(PreArmCheck::kYaw);

/// The reason of the first check in `failing`, a literal; null if there is none.
const char* firstReason(std::uint32_t failing);

}  // namespace helical
