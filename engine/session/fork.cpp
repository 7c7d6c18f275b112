#include "engine/session/fork.h"

#include <memory>

#include "engine/base/error.h"
#include "engine/pipeline/lock_step.h"
#include "engine/pipeline/rig_devices.h"
#include "engine/session/flight_change_text.h"
#include "engine/session/flight_messages.h"
#include "engine/session/flight_repeater.h"
#include "engine/session/session_writer.h"

namespace helical {
namespace {

/// What the operator did before a control tick, and what came of it.
struct PastTick {
  OperatorCommands commands;
  std::vector<DecodedOrder> orders;
  TimeNs time = 0;
  std::string sticks, truth;  ///< payloads
};

struct Recorded {
  std::vector<PastTick> ticks;
  bool crashed = false;
};

Recorded readTicks(McapReader& session, TimeNs until) {
  Recorded recorded;
  PastTick next;
  EngineSnapshot state;
  Words words;
  session.read(withoutImages(session), [&](const McapMessage& message) {
    const std::string& topic = session.channels().at(message.channel).topic;
    if (topic == kOrdersTopic) next.orders.push_back(decodeOrder(message.payload));
    if (topic == kSticksTopic) next.sticks = message.payload;
    if (topic == kTruePoseTopic) next.truth = message.payload;
    if (topic != kFlightStateTopic) return;
    next.commands = decodeFlightState(message.payload, state, words).commands;
    next.time = state.time;
    recorded.crashed = state.has_truth && state.verdict.crashed;
    if (state.time <= until) recorded.ticks.push_back(std::move(next));
    next = {};
  });
  return recorded;
}

bool isAsRecorded(const EngineSnapshot& now, const PastTick& recorded) {
  CdrWriter out;
  encodeSticks(out, now.time, now.sticks);
  if (out.bytes() != recorded.sticks) return false;
  if (!now.has_truth) return recorded.truth.empty();
  encodePose(out, now.time, now.truth.world_from_body);
  return out.bytes() == recorded.truth;
}

void obey(const DecodedOrder& order, const RigConfig& rig, LockStep& flight) {
  if (order.kind == "change") return flight.change(flightChangeOf(order.method, rig.control));
  if (order.camera < 0 || static_cast<std::size_t>(order.camera) >= rig.cameras.size()) throw CutShort();
  if (order.kind == "hide" || order.kind == "show")
    flight.hideCamera(cameraId(order.camera), order.kind == "hide");
  if (order.decided) flight.orderCalibration(*order.decided);
  if (order.kind == "calibrate") flight.calibrate(cameraId(order.camera), order.method, order.seed);
}

void require(bool condition, const std::string& what, const std::string& cure) {
  if (!condition) throw Error(ErrorKind::kInput, what, "--fork-at", cure);
}

RigConfig rigAfter(const RigConfig& rig, const ForkChanges& changes) {
  RigConfig changed = rig;
  for (const Occlusion& occlusion : changes.occlusions) {
    require(occlusion.from_s >= changes.at_s, "a camera cannot be covered before the fork",
            "let --occlude begin after it");
    changed.simulation.occlusions.push_back(occlusion);
  }
  return changed;
}

/// The flight and its world repeat themselves bit for bit.
void repeat(const Recorded& past, const RigConfig& rig, LockStep& flight, Fork& fork,
            const std::function<void(const EngineSnapshot&)>& add) {
  for (const PastTick& tick : past.ticks) {
    for (const DecodedOrder& order : tick.orders) obey(order, rig, flight);
    add(flight.tick(tick.commands));
    ++fork.ticks_before;
    fork.different_before += !isAsRecorded(fork.last, tick);
  }
}

/// The flight repeats itself, its world is led along what was true.
void lead(McapReader& session, TimeNs last_tick, const RigConfig& rig, LockStep& flight, Fork& fork,
          const std::function<void(const EngineSnapshot&)>& add) {
  Replay replay;
  const ReplayChanges none;
  bool reached = false;
  const auto follow = [&](const RecordedTick& tick) {
    reached = tick.time >= last_tick;
    return flight.follow(tick);
  };
  FlightRepeater repeater(session, rig, none, flight.loop(), follow, add, replay);
  session.read(withoutImages(session), [&](const McapMessage& message) {
    if (!reached) repeater.take(message);
  });
  fork.crash_reason = replay.crash_reason;
  fork.ticks_before = replay.ticks;
  fork.different_before = replay.different_ticks;
}

}  // namespace

Fork forkSession(McapReader& session, const SessionSettings& recorded, const ForkChanges& changes,
                 const std::function<void(const EngineSnapshot&)>& listener,
                 const std::function<bool(const EngineSnapshot&)>& is_over) {
  require(!needsRealTime(recorded.rig), "the flight's cameras or transmitter were real: nobody can fly on with them",
          "leave it out: a replay tells what would have been known");
  const Recorded past = readTicks(session, fromSeconds(changes.at_s));
  require(changes.at_s > 0.0 && !past.ticks.empty() && toSeconds(session.lastTime()) >= changes.at_s,
          "the flight was not under way then", "give a time of the flight, in seconds");
  const RigConfig rig = rigAfter(recorded.rig, changes);
  LockStep flight(rig, recorded.plan);
  Fork fork;
  fork.recorded_crashed = past.crashed;
  const auto add = [&](const EngineSnapshot& now) {
    fork.last = now;
    fork.score.add(now);
    listener(now);
  };
  if (recorded.realtime)
    lead(session, past.ticks.back().time, rig, flight, fork, add);
  else
    repeat(past, rig, flight, fork, add);
  for (std::size_t i = 0; !changes.calibrator.empty() && i < rig.cameras.size(); ++i)
    flight.calibrate(cameraId(static_cast<int>(i)), changes.calibrator, rig.simulation.seed + i);
  while (!is_over(fork.last)) add(flight.tick({}));
  return fork;
}

}  // namespace helical
