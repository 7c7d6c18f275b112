#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "engine/flight/flight_plan.h"

namespace helical {

/// Loads a flight plan (TOML; the format is in resources/plans/README.md). Errors as `loadRig`.
FlightPlan loadPlan(const std::filesystem::path& file);
FlightPlan parsePlan(std::string_view toml, const std::string& name);

}  // namespace helical
