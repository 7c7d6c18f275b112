#pragma once

#include "engine/base/ids.h"
#include "engine/geometry/camera_model.h"
#include "engine/helicopter/marker_layout.h"
#include "engine/simulator/simulation_options.h"

namespace helical {

/// What the simulated field is really like where the rig is told otherwise (`marker_error_m`, `focal_error`),
/// drawn from the seed. The estimator learns of it from pixels alone.
MarkerLayout trueMarkers(const MarkerLayout& told, const SimulationOptions& options);
CameraModel trueModel(CameraId camera, const CameraModel& told, const SimulationOptions& options);

}  // namespace helical
