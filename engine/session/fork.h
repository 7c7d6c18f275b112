#pragma once

#include <functional>
#include <memory>
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
  std::shared_ptr<const std::string> crash_reason;  ///< keeps what `last.verdict` points to
  std::uint64_t ticks_before = 0;      ///< up to the fork
  std::uint64_t different_before = 0;  ///< of them not as recorded, in any bit
  bool recorded_crashed = false;       ///< the flight that was
};

/// Flies a simulated session again up to a time, with the recorded orders, and on from there with other
/// settings: the world itself goes on, so that it tells whether it would have crashed. Nobody gives orders
/// after the fork, and boards, noise and losses that the operator laid over frames end there.
///
/// Its seed repeats a flight in lock step bit for bit, world and all. Of one in real time the flight loop repeats
/// bit for bit what reached it; the world is led along the recorded true state, so that at the fork the rotors'
/// speeds are right to a few milliseconds of sticks, and the air that blows from then on is other air.
/// `listener` sees every tick; it ends when `is_over` says so. Throws Error(kInput) for real cameras, times
/// outside the flight, changes before the fork.
Fork forkSession(McapReader& session, const SessionSettings& recorded, const ForkChanges& changes,
                 const std::function<void(const EngineSnapshot&)>& listener,
                 const std::function<bool(const EngineSnapshot&)>& is_over);

}  // namespace helical
