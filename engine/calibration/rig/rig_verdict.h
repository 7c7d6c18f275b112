#pragma once

#include <span>

#include "engine/calibration/rig/rig_calibration.h"

namespace helical {

/// Judges a calibration: sets its verdict and reasons. Good: fly on it. Usable: it will do, the reasons say
/// what would make it better. Bad: do not use it.
void judge(RigCalibration& calibration, std::span<const RigCamera> cameras);

}  // namespace helical
