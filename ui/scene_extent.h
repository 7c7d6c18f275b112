#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "ui/scene_frame.h"

namespace helical {

/// Points that enclose all that stands in the scene [m, world]: the cameras of known place with what is drawn of their
/// view, and the air above the pad.
std::vector<Eigen::Vector3d> sceneExtent(const SceneSetup& setup, const SceneFrame& frame);

/// Which cameras stand somewhere, one bit each.
std::uint32_t knownCameras(const SceneFrame& frame);

}  // namespace helical
