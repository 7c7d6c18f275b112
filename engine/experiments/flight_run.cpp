#include "engine/experiments/flight_run.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>

#include "engine/base/clock.h"
#include "engine/base/error.h"
#include "engine/base/log.h"
#include "engine/pipeline/engine.h"
#include "engine/pipeline/lock_step.h"
#include "engine/pipeline/rig_devices.h"
#include "engine/pipeline/rig_hardware.h"

namespace helical {
namespace {

constexpr double kAfterwardsS = 0.5;  // watched after the flight has ended
constexpr double kShortestFlightS = 6.0;
constexpr double kLongestLiftOffS = 8.0;
constexpr double kLongestTurnS = 6.0;  // half a turn at the reference's yaw rate
constexpr double kPutDownS =
    1.0;  // after it was carried, and the time before that in which the field is empty

constexpr double kPatienceS = 20.0;  // for the pre-arm checks, after which the flight is given up

/// The operator of a headless flight: arms and takes off once every check passes, and knows when it is over.
class Operator {
 public:
  /// `carried_s`: for so long it is carried about first. `looks_on`: the rig's cameras are recordings.
  Operator(double limit_s, double carried_s, bool looks_on, std::span<const TimedOrder> orders)
      : end_(limit_s), carried_s_(carried_s), looks_on_(looks_on), orders_(orders) {}

  /// The next order that is due, once; null: none.
  const CalibrationOrder* due(const EngineSnapshot& now) {
    if (given_ == orders_.size() || toSeconds(now.time) < orders_[given_].at_s) return nullptr;
    return &orders_[given_++].order;
  }

  bool wantsTakeOff(const EngineSnapshot& now) {
    if (ordered_ || !now.pose_known || now.failing_checks != 0) return false;
    if (carried_s_ > 0.0 && toSeconds(now.time) < carried_s_ + kPutDownS) return false;
    ordered_ = true;
    return true;
  }

  bool isOver(const EngineSnapshot& now) {
    if (looks_on_) return end_.isOver(now) || haveEnded(now);
    const bool never_armed = !ordered_ && toSeconds(now.time) > carried_s_ + kPatienceS;
    return end_.isOver(now) || never_armed;
  }

 private:
  static bool haveEnded(const EngineSnapshot& now) {
    return std::none_of(now.cameras.begin(), now.cameras.begin() + now.camera_count,
                        [](const CameraSnapshot& camera) { return camera.link == LinkState::kStreaming; });
  }

  FlightEnd end_;
  double carried_s_;
  bool looks_on_;
  std::span<const TimedOrder> orders_;
  std::size_t given_ = 0;
  bool ordered_ = false;
};

void giveOrders(LockStep& flight, Operator& pilot, const EngineSnapshot& now) {
  while (const CalibrationOrder* order = pilot.due(now))
    if (const char* refusal = flight.orderCalibration(*order))
      log(LogLevel::kWarning, std::string("no ") + toString(order->kind) + ": " + refusal);
}

/// The engine's events tell what became of them.
void giveOrders(Engine& engine, Operator& pilot, const EngineSnapshot& now) {
  while (const CalibrationOrder* order = pilot.due(now))
    if (!engine.orderCalibration(*order))
      log(LogLevel::kWarning, std::string("no ") + toString(order->kind) + ": the engine is still busy");
}

void fly(LockStep& flight, Operator& pilot, FlightRun& run, const TickListener& listener) {
  OperatorCommands commands;
  do {
    run.last = flight.tick(commands);
    run.score.add(run.last);
    run.links.add(run.last);
    commands.arm = commands.take_off = pilot.wantsTakeOff(run.last);
    giveOrders(flight, pilot, run.last);
    listener(run.last);
  } while (!pilot.isOver(run.last));
}

void fly(Engine& engine, Operator& pilot, FlightRun& run, const TickListener& listener) {
  engine.start();
  for (bool over = false; !over;) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    while (!over && engine.nextTick(run.last)) {
      run.score.add(run.last);
      run.links.add(run.last);
      if (pilot.wantsTakeOff(run.last)) {
        engine.arm();
        engine.takeOff();
      }
      giveOrders(engine, pilot, run.last);
      listener(run.last);
      over = pilot.isOver(run.last);
    }
  }
  engine.stop();
}

}  // namespace

void landWithin(FlightPlan& plan, double session_s) {
  const double around = kBeforeStartS + plan.carried_s + plan.start_delay_s + kLandingS;
  if (session_s < around + kShortestFlightS)
    throw Error(ErrorKind::kInput,
                "a session of " + std::to_string(session_s) + " seconds is too short to fly", {},
                "give at least " + std::to_string(around + kShortestFlightS) + " seconds");
  plan.land_at_s = session_s - around;
}

double plannedSeconds(const FlightPlan& plan) {
  double total = kBeforeStartS + plan.carried_s + plan.start_delay_s + kLandingS;
  if (plan.land_at_s > 0.0) return total + plan.land_at_s;
  total += kLongestLiftOffS + plan.waypoints.front().position_above_pad.z() / plan.climb_speed +
           plan.waypoints.front().position_above_pad.head<2>().norm() / plan.waypoints.front().speed;
  for (std::size_t i = 0; i < plan.waypoints.size(); ++i) {
    total += plan.waypoints[i].hold_s + kLongestTurnS;
    if (i > 0)
      total += (plan.waypoints[i].position_above_pad - plan.waypoints[i - 1].position_above_pad).norm() /
               plan.waypoints[i].speed;
  }
  return total;
}

bool FlightEnd::isOver(const EngineSnapshot& now) {
  const bool landed = now.phase == FlightPhase::kOff && (now.verdict.at_rest || !now.has_truth);
  if (!landed && !now.verdict.crashed)
    ended_ = -1;
  else if (ended_ < 0)
    ended_ = now.time;
  return toSeconds(now.time) >= limit_s_ || (ended_ >= 0 && toSeconds(now.time - ended_) >= kAfterwardsS);
}

FlightRun runFlight(const RigConfig& rig, const FlightPlan& plan, double limit_s, bool realtime,
                    const TickListener& listener, FlightTap* tap, std::span<const TimedOrder> orders) {
  FlightRun run;
  Operator pilot(limit_s, plan.carried_s, isOfRecordings(rig), orders);
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
