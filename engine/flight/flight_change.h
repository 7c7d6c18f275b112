#pragma once

#include <optional>

#include "engine/flight/controller_options.h"
#include "engine/flight/flight_plan.h"

namespace helical {

/// What the operator changes of a flight under way: all of it at one control tick, or nothing.
struct FlightChange {
  std::optional<FlightPlan> plan;            ///< flown on from the waypoint of the same number
  std::optional<ControllerOptions> control;  ///< gains and trims; rate and output delay stay as they are
};

/// Throws Error(kInput) naming the offending value: a plan that `validate(plan)` refuses, a gain or trim
/// outside of its safe range.
void validate(const FlightChange& change);

}  // namespace helical
