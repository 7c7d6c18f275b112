#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/pipeline/flight_score.h"
#include "engine/session/mcap_reader.h"
#include "engine/session/session_settings.h"

namespace helical {

/// What is otherwise from the fork on.
struct ForkChanges {
  double at_s = 0.0;
  std::vector<Occlusion> occlusions;  ///< not before the fork
  std::string calibrator;             ///< empty: as it was
};

struct Fork {
  FlightScore score;
  EngineSnapshot last;
  std::uint64_t ticks_before = 0;      ///< up to the fork
  std::uint64_t different_before = 0;  ///< of them not as recorded, in any bit of sticks or true pose
  bool recorded_crashed = false;       ///< the flight that was
};

/// Flies a simulated session again up to a time, with the recorded orders, and on from there with other
/// settings: the world itself goes on, so that it tells whether it would have crashed. Nobody gives orders
/// after the fork. For flights in lock step, which their seed repeats bit for bit. `listener` sees every
/// tick; it ends when `is_over` says so. Throws Error(kInput) for flights in real time, times outside the
/// flight, changes before the fork.
Fork forkSession(McapReader& session, const SessionSettings& recorded, const ForkChanges& changes,
                 const std::function<void(const EngineSnapshot&)>& listener,
                 const std::function<bool(const EngineSnapshot&)>& is_over);

}  // namespace helical
