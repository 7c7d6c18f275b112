#pragma once

#include <string>

#include "engine/experiments/flight_run.h"

namespace helical {

/// The object that `helical fly --json` prints; its fields are a contract for scripts.
std::string flightJson(const FlightRun& run, const RigConfig& rig);

/// The same for people.
std::string flightText(const FlightRun& run, const RigConfig& rig);

}  // namespace helical
