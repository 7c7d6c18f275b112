#pragma once

#include <span>
#include <vector>

#include "engine/calibration/rig/rig_state.h"

namespace helical {

/// A camera's view of the body at one time, and the poses it can have: two for a planar body seen from afar.
struct BodyView {
  std::int32_t item = 0;
  std::int32_t camera = 0;
  std::vector<RigidTransform> camera_from_body;
};

/// Poses of all views of at least four points that are not on one line, with outliers among the points left
/// out. Views that no pose explains are missing.
std::vector<BodyView> poseBodyViews(std::span<const RigCamera> cameras, const SightingTable& table,
                                    double tolerance_px);

}  // namespace helical
