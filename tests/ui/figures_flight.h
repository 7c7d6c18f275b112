#pragma once

#include "engine/experiments/flight_trace.h"

namespace helical {

/// A flight like the paper's, made up: take-off at 2 s, hover, camera 2 covered from 13 s, landing from 22 s
/// to 25 s, 60 ticks a second. Repeatable.
FlightTrace landedFlight();

/// Another whose estimate of camera 3 is far off; it drifts away when camera 2 is covered and crashes at
/// 16.5 s.
FlightTrace crashedFlight();

}  // namespace helical
