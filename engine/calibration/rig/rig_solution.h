#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/calibration/rig/free_body.h"
#include "engine/calibration/rig/rig_calibration.h"
#include "engine/calibration/rig/rig_state.h"
#include "engine/calibration/rig/sightings.h"

namespace helical {

/// A rig solved for from one recording.
struct RigSolution {
  std::vector<RigCamera> cameras;
  SightingTable table;
  std::optional<FreeBody> body;  ///< if it is solved for
  RigState state;
  double sigma_px = 0.0;
  double explained = 0.0;  ///< share of sightings
};

/// From nothing, of the likelier timing: the one whose residuals are smaller, if it explains about as much.
/// Delays are sought unless the options trust the stamps. The world is the first solved camera's.
RigSolution solveLikeliest(std::vector<SightingTable> tables, std::span<const RigCamera> cameras,
                           const RigCalibrationOptions& options, const ProgressCallback& progress);

/// Gate and bundle in turn until both have settled; plain least squares at the end.
void refine(RigSolution& s);

}  // namespace helical
