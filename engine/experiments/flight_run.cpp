#include "engine/experiments/flight_run.h"

#include <chrono>
#include <memory>
#include <thread>

#include "engine/base/clock.h"
#include "engine/base/error.h"
#include "engine/pipeline/engine.h"
#include "engine/pipeline/lock_step.h"
#include "engine/pipeline/rig_hardware.h"

namespace helical {
namespace {

constexpr double kAfterwardsS = 0.5;  // watched after the flight has ended
constexpr double kShortestFlightS = 6.0;

/// The operator of a headless flight: orders the take-off once the pose is known, and knows when it is over.
class Operator {
 public:
  explicit Operator(double limit_s) : limit_s_(limit_s) {}

  bool wantsTakeOff(const EngineSnapshot& now) {
    if (ordered_ || !now.pose_known) return false;
    ordered_ = true;
    return true;
  }

  bool isOver(const EngineSnapshot& now) {
    const bool landed = now.phase == FlightPhase::kOff && (now.verdict.at_rest || !now.has_truth);
    if (!landed && !now.verdict.crashed)
      ended_ = -1;
    else if (ended_ < 0)
      ended_ = now.time;
    return toSeconds(now.time) >= limit_s_ || (ended_ >= 0 && toSeconds(now.time - ended_) >= kAfterwardsS);
  }

 private:
  double limit_s_;
  bool ordered_ = false;
  TimeNs ended_ = -1;
};

void fly(LockStep& flight, Operator& pilot, FlightRun& run, const TickListener& listener) {
  OperatorCommands commands;
  do {
    run.last = flight.tick(commands);
    run.score.add(run.last);
    commands.take_off = pilot.wantsTakeOff(run.last);
    listener(run.last);
  } while (!pilot.isOver(run.last));
}

void fly(Engine& engine, Operator& pilot, FlightRun& run, const TickListener& listener) {
  engine.start();
  for (bool over = false; !over;) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    while (!over && engine.nextTick(run.last)) {
      run.score.add(run.last);
      if (pilot.wantsTakeOff(run.last)) engine.takeOff();
      listener(run.last);
      over = pilot.isOver(run.last);
    }
  }
  engine.stop();
}

}  // namespace

void landWithin(FlightPlan& plan, double session_s) {
  const double around = kBeforeStartS + plan.start_delay_s + kLandingS;
  if (session_s < around + kShortestFlightS)
    throw Error(ErrorKind::kInput,
                "a session of " + std::to_string(session_s) + " seconds is too short to fly", {},
                "give at least " + std::to_string(around + kShortestFlightS) + " seconds");
  plan.land_at_s = session_s - around;
}

FlightRun runFlight(const RigConfig& rig, const FlightPlan& plan, double limit_s, bool realtime,
                    const TickListener& listener, FlightTap* tap) {
  FlightRun run;
  Operator pilot(limit_s);
  if (realtime) {
    Engine engine(rig, plan, tap);
    const MonotonicClock stopwatch;
    fly(engine, pilot, run, listener);
    run.wall_s = toSeconds(stopwatch.now());
  } else {
    LockStep flight(rig, plan, tap);
    const MonotonicClock stopwatch;
    fly(flight, pilot, run, listener);
    run.wall_s = toSeconds(stopwatch.now());
  }
  return run;
}

}  // namespace helical
