#pragma once

#include <span>

#include "engine/calibration/rig/point_rows.h"
#include "engine/calibration/rig/rig_state.h"

namespace helical {

/// Camera and body poses in metres, in the frame of the first camera that has any, from views of a body with
/// known points: the pose (for a planar body both possible ones) of each view, how each pair of cameras
/// stands by the views that most others agree with, and the pairs that agree most as a tree. Cameras that the
/// tree does not reach keep no pose.
RigState chainBodies(std::span<const RigCamera> cameras, SightingTable& table, double tolerance_px,
                     const ProgressCallback& progress = {});

}  // namespace helical
