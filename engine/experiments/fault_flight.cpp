#include "engine/experiments/fault_flight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/experiments/fault_detection.h"
#include "engine/experiments/faulty_field.h"
#include "engine/experiments/flight_run.h"
#include "engine/flight/autopilot.h"
#include "engine/geometry/rotation.h"
#include "engine/pipeline/flight_loop.h"

namespace helical {
namespace {

constexpr double kOrderEveryS = 0.1;
constexpr double kLimitS = 45.0;
constexpr double kSeenLatelyS = 0.25;   // a camera counts as seeing for so long
constexpr double kPoseWrongM = 0.15;
constexpr double kYawWrong = kPi / 4.0;

/// Orders to arm whatever the checks say, then to take off.
class PushyOperator {
 public:
  OperatorCommands commands(const EngineSnapshot& last) {
    OperatorCommands orders;
    if (last.phase != FlightPhase::kIdle) return orders;
    const double time_s = toSeconds(last.time);
    orders.take_off = last.armed;
    orders.arm = !last.armed && time_s - last_order_s_ >= kOrderEveryS;
    if (orders.arm) last_order_s_ = time_s;
    return orders;
  }

 private:
  double last_order_s_ = 0.0;
};

/// Whether it may arm, from the truth: what the supervisor knows only through its instruments.
class ArmingJudge {
 public:
  void onObservation(const Observation& observation, TimeNs now) {
    if (observation.count > 0) seen_[static_cast<std::size_t>(observation.camera.index())] = now;
  }
  /// At the tick at which it has armed.
  bool mustNotArm(const EngineSnapshot& tick) const {
    const auto seeing = std::count_if(seen_.begin(), seen_.end(), [&](TimeNs seen) {
      return seen >= 0 && toSeconds(tick.time - seen) < kSeenLatelyS;
    });
    const RigidTransform& believed = tick.tracked.state.world_from_body;
    const RigidTransform& truth = tick.truth.world_from_body;
    const double yaw_error = std::remainder(yawOf(believed.rotation) - yawOf(truth.rotation), 2.0 * kPi);
    return tick.devices.transmitter.fault || !tick.devices.transmitter.present || tick.devices.record.cut_off ||
           seeing < 2 || !tick.has_truth || (believed.translation - truth.translation).norm() > kPoseWrongM ||
           std::abs(yaw_error) > kYawWrong;
  }

 private:
  std::array<TimeNs, kMaxCameras> seen_ = [] {
    std::array<TimeNs, kMaxCameras> never{};
    never.fill(-1);
    return never;
  }();
};

}  // namespace

FaultFlight flyWithFaults(const RigConfig& rig, const FlightPlan& plan, std::uint64_t seed) {
  FaultFlight flight;
  flight.seed = seed;
  flight.faults = drawFaults(seed, static_cast<int>(rig.cameras.size()));
  flight.farthest_beyond = -std::numeric_limits<double>::infinity();
  FaultyField field(rig, seed, flight.faults);
  FlightLoop loop(field.rig(), plan);
  FaultDetection detection(flight.faults);
  PushyOperator pilot;
  ArmingJudge judge;
  FlightEnd end(kLimitS);
  EngineSnapshot snapshot;
  TimeNs busy_until = 0;
  for (std::int64_t tick = 1;; ++tick) {
    const TimeNs tick_time = fromSeconds(field.tickPeriod() * static_cast<double>(tick));
    while (field.now() < tick_time) {
      field.advance();
      Observation observation;
      for (auto& source : field.sources())
        while (field.now() >= busy_until && source->poll(observation)) {
          loop.onObservation(observation, field.now());
          judge.onObservation(observation, field.now());
        }
    }
    const bool was_armed = snapshot.armed;
    if (field.now() >= busy_until) {
      OperatorCommands commands = pilot.commands(snapshot);
      commands.kill = field.output().stopped();
      field.output().submit(loop.onTick(field.now(), commands, field.devices()), field.now());
      busy_until = field.now() + field.starvation();
    }
    // On a clock of its own, whatever the flight thread does.
    field.output().step(field.now());
    snapshot = loop.snapshot();
    snapshot.time = field.now();
    field.hardware().addTruth(snapshot, field.now());
    if (snapshot.armed && !was_armed) flight.bad_arming = flight.bad_arming || judge.mustNotArm(snapshot);
    flight.flown = flight.flown || rotorsTurn(snapshot.phase);
    if (snapshot.has_truth && field.powered())
      flight.farthest_beyond = std::max(flight.farthest_beyond, field.beyondHardFence(snapshot.truth));
    detection.add(snapshot);
    if (end.isOver(snapshot)) break;
  }
  flight.verdict = snapshot.verdict;
  flight.outcome = outcomeOf(snapshot.verdict, snapshot.failsafes);
  flight.detections = detection.result();
  return flight;
}

Verdict flyOracle(const RigConfig& rig, const FlightPlan& plan, std::uint64_t seed) {
  FaultyField field(rig, seed, drawFaults(seed, static_cast<int>(rig.cameras.size())));
  const RigConfig& flown = field.rig();
  Autopilot autopilot(plan, flown.control, flown.safety, flown.helicopter);
  PushyOperator pilot;
  FlightEnd end(kLimitS);
  EngineSnapshot snapshot;
  for (std::int64_t tick = 1;; ++tick) {
    const TimeNs tick_time = fromSeconds(field.tickPeriod() * static_cast<double>(tick));
    while (field.now() < tick_time) field.advance();
    const DeviceStatus devices = field.devices();
    AutopilotInput input;
    input.now = snapshot.time = field.now();
    field.hardware().addTruth(snapshot, field.now());
    input.pose_known = snapshot.has_truth;
    input.pose_age_s = snapshot.has_truth ? 0.0 : 1.0;
    input.state = snapshot.truth;
    const double ahead = flown.control.output_delay_s;
    input.state.world_from_body.translation += ahead * input.state.velocity_in_world;
    input.state.world_from_body.rotation =
        (input.state.world_from_body.rotation * expSO3(ahead * input.state.angular_velocity_in_body)).normalized();
    input.commands = pilot.commands(snapshot);
    input.commands.kill = field.output().stopped();
    input.health.transmitter_ready = devices.transmitter.present && devices.transmitter.self_test_passed;
    input.health.transmitter_fault = devices.transmitter.fault || !devices.transmitter.present;
    input.health.record_failed = devices.record.cut_off;
    input.health.disk_free_gb = devices.record.disk_free_gb;
    const AutopilotOutput output = autopilot.step(input);
    field.output().submit(output.sticks, field.now());
    field.output().step(field.now());
    snapshot.phase = output.phase;
    snapshot.armed = output.armed;
    if (end.isOver(snapshot)) return snapshot.verdict;
  }
}

}  // namespace helical
