#pragma once

#include <array>

#include "engine/base/random.h"
#include "engine/flight/supervisor.h"

namespace helical::test {

inline constexpr double kTick = 1.0 / 60.0;
inline constexpr std::array kPhases{FlightPhase::kIdle,   FlightPhase::kSpinUp,  FlightPhase::kLiftOff,
                                    FlightPhase::kFlying, FlightPhase::kLanding, FlightPhase::kTouchdown,
                                    FlightPhase::kOff};

inline bool raised(const SupervisorMemory& memory, Failsafe failsafe) {
  return (memory.failsafes & bitOf(failsafe)) != 0;
}

/// A supervisor in flight at 60 ticks per second; tests change the conditions.
struct SupervisedFlight {
  SupervisorOptions options;
  SupervisorMemory memory;
  SupervisorConditions conditions;

  explicit SupervisedFlight(FlightPhase phase = FlightPhase::kFlying) {
    conditions.phase = phase;
    if (inTheAir(phase)) conditions.place.z() = 0.6;
  }
  const SupervisorMemory& tick() {
    conditions.now += fromSeconds(kTick);
    conditions.flight_time_s += kTick;
    return memory = supervise(options, memory, conditions);
  }
  /// Ticks without a pose for as long as `seconds`.
  void blindFor(double seconds) {
    const double end = conditions.pose_age_s + seconds;
    while (conditions.pose_age_s + kTick <= end) {
      conditions.pose_age_s += kTick;
      tick();
    }
  }
  SafetyState state() const { return memory.state; }
};

/// Anything, most of it mild.
SupervisorConditions randomConditions(Random& random, TimeNs now);

}  // namespace helical::test
