#pragma once

#include <vector>

#include "engine/config/calibration_file.h"
#include "engine/config/rig_config.h"
#include "engine/pipeline/calibration_order.h"
#include "engine/pipeline/snapshot.h"

namespace helical {

/// The cameras of the control set as they stand now. Throws Error(kInput) if there is none.
SavedCalibration calibrationOf(const RigConfig& rig, const EngineSnapshot& now);

/// One camera of it alone. Throws Error(kInput) if it is not in there.
SavedCalibration onlyOf(const SavedCalibration& saved, const CameraConfig& camera);

/// To put every camera that the calibration names where it says. In flight no balls are taken over: how far
/// its balls are from those `flown_with` is in the orders. Throws Error(kInput) for a camera that the rig
/// lacks, and for a helicopter of more or fewer balls.
std::vector<CalibrationOrder> adoptOrders(const SavedCalibration& saved, const RigConfig& rig,
                                          const MarkerLayout& flown_with);

/// The rig with its cameras where the calibration says, as if its file said so. Where simulated ones truly are
/// stays.
void giveCalibration(const SavedCalibration& saved, RigConfig& rig);

}  // namespace helical
