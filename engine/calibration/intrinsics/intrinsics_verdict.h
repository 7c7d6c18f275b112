#pragma once

#include "engine/calibration/intrinsics/intrinsics_calibration.h"

namespace helical {

/// Sets the verdict and its reasons.
void judge(IntrinsicsCalibration& calibration);

}  // namespace helical
