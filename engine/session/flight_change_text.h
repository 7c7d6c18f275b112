#pragma once

#include <string>

#include "engine/flight/flight_change.h"

namespace helical {

/// A flight change as one line of JSON and back, to the last bit. SI and radians. `flightChangeOf` throws
/// CutShort for what does not make sense; what cannot be changed in flight comes from `control`.
std::string textOf(const FlightChange& change);
FlightChange flightChangeOf(const std::string& text, const ControllerOptions& control);

}  // namespace helical
