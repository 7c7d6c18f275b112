#pragma once

#include <cstdint>

#include "engine/flight/flight_state.h"
#include "engine/flight/supervisor_options.h"

namespace helical {

/// What the supervisor is told at a control tick.
struct SupervisorConditions {
  TimeNs now = 0;
  FlightPhase phase = FlightPhase::kIdle;
  double pose_age_s = 0.0;         ///< since the last observation that was used
  double tilt = 0.0;               ///< rad
  double distance_from_pad = 0.0;  ///< m, horizontal
  double height_above_pad = 0.0;   ///< m
  double flight_time_s = 0.0;      ///< since the rotors started
  bool lift_off_failed = false;
  bool kill = false;
};

/// An open-loop descent ends this long after it should have reached the ground, in seconds.
inline constexpr double kSettleOnSkids = 1.0;

/// What it remembers from tick to tick.
struct SupervisorMemory {
  SafetyState state = SafetyState::kNormal;
  std::uint32_t failsafes = 0;
  TimeNs tilted_since = -1;
  TimeNs descending_since = -1;
  double descent_s = 0.0;  ///< how long the descent may last, fixed when it begins
};

/// The safety state machine: a pure function of memory and conditions. Kill always wins, cut is latched,
/// coasting and descending end when the pose is back. See engine/flight/README.md for the table of triggers.
SupervisorMemory supervise(const SupervisorOptions& options, const SupervisorMemory& memory,
                           const SupervisorConditions& conditions);

}  // namespace helical
