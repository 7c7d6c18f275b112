#pragma once

#include "engine/config/rig_config.h"
#include "engine/flight/flight_plan.h"

namespace helical {

/// Opens the ground-control window on this rig and returns its exit code when it is closed. Simulated cameras
/// without a pose get a first guess and are calibrated in flight. `demonstration`: the plan begins as soon as
/// the pose is known, and the calibrator is one with something to see. Throws Error(kSystem) where there is
/// no display, and what the engine throws when it cannot start. HELICAL_PRINT_STARTUP=1 prints the time to
/// the first picture on stderr.
int runWindow(int argc, char** argv, RigConfig rig, const FlightPlan& plan, bool demonstration);

}  // namespace helical
