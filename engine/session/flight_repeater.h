#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "engine/pipeline/flight_loop.h"
#include "engine/pipeline/lock_step.h"
#include "engine/session/flight_messages.h"
#include "engine/session/mcap_reader.h"
#include "engine/session/replay.h"

namespace helical {

/// Goes through a session's messages in their order and gives a flight loop what it got in that flight: every
/// observation, order and tick as it was used. Counts the ticks that come out otherwise. One thread.
class FlightRepeater {
 public:
  /// Ticks the loop; the state after it, truth not needed.
  using Ticker = std::function<EngineSnapshot(const RecordedTick&)>;

  /// All outlive it; `listener` sees every tick with the recorded truth.
  FlightRepeater(const McapReader& session, const RigConfig& rig, const ReplayChanges& changes, FlightLoop& loop,
                 Ticker ticker, const std::function<void(const EngineSnapshot&)>& listener, Replay& replay);

  /// Throws CutShort for what does not fit the messages' definition.
  void take(const McapMessage& message);

 private:
  void observe(std::size_t camera, DecodedObservation decoded);
  void obey(const DecodedOrder& order);
  void tick(const DecodedTick& decoded);
  void addTruth(EngineSnapshot& now);
  void compare(const EngineSnapshot& now);
  void countMissing(std::uint64_t order);

  const McapReader& session_;
  const RigConfig& rig_;
  const ReplayChanges& changes_;
  FlightLoop& loop_;
  Ticker ticker_;
  const std::function<void(const EngineSnapshot&)>& listener_;
  Replay& replay_;
  std::map<std::string, std::size_t> observation_topics_, true_pose_topics_;
  std::map<std::string, std::string> recorded_;  ///< topic to payload, since the last tick
  RecordedTick next_;                            ///< with the newest truth
  HelicopterState truth_;
  EngineSnapshot state_;  ///< as recorded, with the newest flight state
  Words words_;
  std::uint64_t last_order_ = 0;
};

}  // namespace helical
