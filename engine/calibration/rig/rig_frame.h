#pragma once

#include <optional>
#include <span>

#include "engine/calibration/rig/rig_calibration.h"
#include "engine/calibration/rig/rig_state.h"

namespace helical {

/// How far given poses are from the solved ones after alignment.
struct GivenPoseError {
  double degrees = 0.0;
  double metres = 0.0;
};

/// Brings a solution to its scale and world: those of the given cameras, else the given distance, else as it
/// is; without given poses the first solved camera becomes the world. Given poses are not put in yet.
GivenPoseError alignToGiven(RigState& state, std::span<const RigCamera> cameras, bool metric_already,
                            const std::optional<KnownDistance>& scale);

/// Puts the given poses in and fixes them.
void fixGiven(RigState& state, std::span<const RigCamera> cameras);

}  // namespace helical
