#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/config/rig_config.h"
#include "engine/flight/flight_plan.h"
#include "engine/session/image_recording.h"

namespace helical {

struct WindowFlight {
  RigConfig rig;
  FlightPlan plan;
  std::filesystem::path plan_file;
  bool demonstration = false;  ///< the plan begins as soon as the pose is known, with a calibrator to look at
  bool record = true;          ///< to the user's folder of sessions
  std::vector<ImageRecording> images;  ///< in the record
};

/// Opens the ground-control window on this rig and returns its exit code when it is closed. Simulated cameras
/// without a pose get a first guess and are calibrated in flight. Offers to mend records that were cut off.
/// Throws Error(kSystem) where there is no display, and what the engine throws when it cannot start.
/// HELICAL_PRINT_STARTUP=1 prints the time to the first picture on stderr.
int runWindow(int argc, char** argv, WindowFlight flight);

/// The window on a recorded flight. Throws Error(kInput) for what is no session, Error(kSystem) without a
/// display.
int runSessionWindow(int argc, char** argv, const std::string& session);

}  // namespace helical
