#pragma once

#include <span>

#include "engine/calibration/rig/rig_state.h"

namespace helical {

/// Places every point that two posed cameras see, and marks as inliers the sightings within `tolerance_px` of
/// it: the point that most sightings agree on, over all pairs of cameras and where it was before. Points that
/// fewer than two sightings agree on are left out.
void placePoints(RigState& state, std::span<const RigCamera> cameras, SightingTable& table,
                 double tolerance_px);

/// Standard deviation of a pixel [px, per axis] by the median inlier residual, corrected for what the items'
/// own parameters have taken up.
double sightingSigma(const RigState& state, std::span<const RigCamera> cameras, const SightingTable& table);

/// Marks as inliers the sightings within `tolerance_px` of where the state puts them; items left with fewer
/// than `fewest` of them lose theirs and, for points, their place.
void gateSightings(RigState& state, std::span<const RigCamera> cameras, SightingTable& table,
                   double tolerance_px, int fewest);

}  // namespace helical
