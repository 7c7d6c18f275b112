#include "engine/session/replay.h"

#include "engine/base/error.h"
#include "engine/pipeline/flight_loop.h"
#include "engine/session/flight_repeater.h"

namespace helical {

Replay replaySession(McapReader& session, const SessionSettings& settings, const ReplayChanges& changes,
                     const std::function<void(const EngineSnapshot&)>& listener) {
  Replay replay;
  FlightLoop loop(settings.rig, settings.plan);
  const auto tick = [&loop](const RecordedTick& recorded) {
    loop.onTick(recorded.time, recorded.commands, recorded.devices);
    return loop.snapshot();
  };
  FlightRepeater repeater(session, settings.rig, changes, loop, tick, listener, replay);
  replay.damaged_chunks =
      session.read(withoutImages(session), [&](const McapMessage& message) { repeater.take(message); })
          .damaged_chunks;
  if (replay.ticks == 0)
    throw Error(ErrorKind::kInput, "the session ends before the flight's first moment",
                session.file().string(), "give a longer one");
  return replay;
}

}  // namespace helical
