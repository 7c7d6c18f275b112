#pragma once

#include "engine/pipeline/camera_calibration.h"
#include "engine/pipeline/snapshot.h"

namespace helical {

/// What a camera's calibrator believes, thinned out: every so many particles, so that the cloud keeps its
/// shape, with weights over that of the heaviest one. Allocates nothing.
void fillView(const CameraCalibration& calibration, CalibrationView& view);

/// Between two of them [control ticks].
inline constexpr std::uint64_t kCalibrationViewTicks = 2;

}  // namespace helical
