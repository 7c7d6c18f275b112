#pragma once

#include <span>
#include <vector>

#include "engine/calibration/rig/point_rows.h"
#include "engine/calibration/rig/rig_camera.h"

namespace helical {

/// How much later (up to a second, to half a period) than their stamps say the cameras saw that do not fit:
/// the shift in time at which most of what such a camera saw lies on epipolar lines of another one. The
/// others are those which fit, or the one that saw most. Zero where none stands out. `rows` are in order of
/// time. Repeats bit for bit.
std::vector<double> wideDelays(const PointRows& rows, std::span<const RigCamera> cameras,
                               const std::vector<bool>& misfit, double period_s, double tolerance_px);

}  // namespace helical
