#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/pipeline/flight_score.h"
#include "engine/session/mcap_reader.h"
#include "engine/session/session_settings.h"

namespace helical {

/// How the pipeline did with what was recorded.
struct Replay {
  FlightScore score;
  EngineSnapshot last;
  std::shared_ptr<const std::string> crash_reason;  ///< keeps what `last.verdict` points to
  std::uint64_t ticks = 0;
  std::uint64_t missing = 0;          ///< things that reached the flight thread and are not in the session
  std::uint64_t damaged_chunks = 0;   ///< of the file
  std::uint64_t different_ticks = 0;  ///< that came out otherwise, in any bit of pose, set-point or sticks
  double first_difference_s = -1.0;   ///< negative: none
  bool other_methods = false;         ///< where the operator began a calibration anew, another one was used
  RunningRms position_difference;     ///< of the pose from the recorded one [m]
};

/// What a replay changes.
struct ReplayChanges {
  std::vector<Occlusion> occlusions;  ///< nothing is seen by these cameras in these times
  bool other_calibrator = false;      ///< that of the settings, also where the operator began one anew
};

/// Runs a session's observations through the flight loop again, in the order in which they reached it, and
/// compares each tick with the recorded one. With `settings` as recorded and no changes every bit comes out
/// the same; otherwise it tells what would have been known (the helicopter itself flew as it did). `listener`
/// sees every tick, with the recorded truth. Throws Error(kInput) when this is no session of ours.
Replay replaySession(McapReader& session, const SessionSettings& settings, const ReplayChanges& changes,
                     const std::function<void(const EngineSnapshot&)>& listener);

}  // namespace helical
