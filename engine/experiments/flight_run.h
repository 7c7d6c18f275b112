#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/config/rig_config.h"
#include "engine/flight/flight_plan.h"
#include "engine/pipeline/flight_score.h"
#include "engine/pipeline/flight_tap.h"
#include "engine/pipeline/snapshot.h"

namespace helical {

/// How one simulated flight went.
struct FlightRun {
  FlightScore score;
  EngineSnapshot last;  ///< state at the end
  double wall_s = 0.0;
  std::string session;  ///< the file that it was recorded to; empty: none
};

/// Called with the state after every control tick.
using TickListener = std::function<void(const EngineSnapshot&)>;

/// Time a session needs before the rotors start (empty field, finding the pose) and to land.
inline constexpr double kBeforeStartS = 0.5;
inline constexpr double kLandingS = 6.0;

/// Makes the plan land so that a session is over after `session_s`. Throws Error(kInput) when that is too
/// short to fly.
void landWithin(FlightPlan& plan, double session_s);

/// Flies the plan from take-off to rest (or crash, or `limit_s`), headless: in lock step, or with `realtime`
/// in the engine's own threads at the pace of the wall clock. `tap` sees the flight on its thread.
FlightRun runFlight(const RigConfig& rig, const FlightPlan& plan, double limit_s, bool realtime,
                    const TickListener& listener, FlightTap* tap = nullptr);

}  // namespace helical
