#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine/config/rig_config.h"
#include "engine/experiments/link_score.h"
#include "engine/flight/flight_plan.h"
#include "engine/pipeline/calibration_order.h"
#include "engine/pipeline/flight_score.h"
#include "engine/pipeline/flight_tap.h"
#include "engine/pipeline/snapshot.h"

namespace helical {

/// How one simulated flight went.
struct FlightRun {
  FlightScore score;
  LinkScore links;
  EngineSnapshot last;  ///< state at the end
  double wall_s = 0.0;
  std::string session;  ///< the file that it was recorded to; empty: none
};

/// What the operator of a headless flight orders at a time.
struct TimedOrder {
  double at_s = 0.0;
  CalibrationOrder order;
};

/// Called with the state after every control tick.
using TickListener = std::function<void(const EngineSnapshot&)>;

/// Time a session needs before the rotors start (empty field, finding the pose) and to land.
inline constexpr double kBeforeStartS = 0.5;
inline constexpr double kLandingS = 6.0;

/// Makes the plan land so that a session is over after `session_s`. Throws Error(kInput) when that is too
/// short to fly.
void landWithin(FlightPlan& plan, double session_s);

/// Longest time the plan can take: every leg at its speed, every hold.
double plannedSeconds(const FlightPlan& plan);

/// Beyond that, before a flight counts as aborted.
inline constexpr double kTimeToSpareS = 20.0;

/// Knows when a flight is over: at rest with its rotors off or crashed, and watched for a moment after; or at
/// `limit_s`. One flight, every tick of it.
class FlightEnd {
 public:
  explicit FlightEnd(double limit_s) : limit_s_(limit_s) {}
  bool isOver(const EngineSnapshot& now);

 private:
  double limit_s_;
  TimeNs ended_ = -1;
};

/// Flies the plan from take-off to rest (or crash, or `limit_s`; or to the ends of a rig's recordings), headless: in
/// lock step, or with `realtime` in the engine's own threads at the pace of the wall clock. `tap` sees the flight on
/// its thread. `orders` in the order of time; the log tells of refused ones.
FlightRun runFlight(const RigConfig& rig, const FlightPlan& plan, double limit_s, bool realtime,
                    const TickListener& listener, FlightTap* tap = nullptr, std::span<const TimedOrder> orders = {});

}  // namespace helical
