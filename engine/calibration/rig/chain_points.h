#pragma once

#include <span>

#include "engine/calibration/rig/point_rows.h"
#include "engine/calibration/rig/rig_state.h"

namespace helical {

/// Camera poses and points, of arbitrary scale and place, from points that move or stand: essential matrices
/// of all pairs, the best pair first, then camera by camera the one that sees most of the points placed so
/// far, with a bundle adjustment after each. Several first pairs are tried unless one explains nearly
/// everything. Cameras that share too little keep no pose. `tolerance_px`: of a first, rough agreement.
RigState chainPoints(std::span<const RigCamera> cameras, SightingTable& table, double tolerance_px,
                     const ProgressCallback& progress = {});

}  // namespace helical
