#pragma once

#include <cstddef>
#include <optional>

#include "engine/calibration/rig/rig_calibration.h"
#include "engine/calibration/rig/rig_solution.h"

namespace helical {

/// What is wrong with a recording although the residuals of its inliers are small.

/// Whether no camera saw the target leave a line: any number of camera poses explain that.
bool sawOnlyALine(const RigSolution& solution);

/// The instant at which a camera stopped, or began, to see the target where the other cameras do: it was
/// moved, or its rows are another camera's. Nothing if there is none, or fewer than two others tell.
std::optional<CameraMove> whenMoved(const RigSolution& solution, std::size_t camera);

}  // namespace helical
