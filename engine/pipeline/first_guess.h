#pragma once

#include <cstdint>

#include "engine/config/rig_config.h"

namespace helical {

/// Initial error of the camera to calibrate in the paper's experiments (section IV).
inline constexpr double kFirstGuessErrorDeg = 15.0;
inline constexpr double kFirstGuessErrorM = 0.4;

/// Gives each simulated camera without a pose a first guess of it: the true one, turned by `angle` [rad] and
/// shifted by `distance` [m] in a direction drawn for the seed. `replace`: those that have a guess, too. A
/// calibrator starts from it. Throws Error(kInput) when the rig does not say where the camera truly is.
void giveFirstGuesses(RigConfig& rig, double angle, double distance, std::uint64_t seed, bool replace);

}  // namespace helical
