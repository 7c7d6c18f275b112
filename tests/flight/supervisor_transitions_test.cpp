// The supervisor's table of triggers, written down a second time and compared: every combination of
// conditions in every phase, and every transition from one to another.

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/flight/supervised_flight.h"

namespace helical {
namespace {

using test::kTick;

constexpr double kLong = 0.9;  // s: longer than every delay but those of doubt that lands and of a descent

SupervisorConditions quiet(FlightPhase phase) {
  SupervisorConditions c;
  c.phase = phase;
  if (inTheAir(phase)) c.place.z() = 0.6;
  return c;
}

/// What is demanded after `kLong` of these conditions, and what of it stays when they end.
struct Demand {
  SafetyState now = SafetyState::kNormal;
  SafetyState stays = SafetyState::kNormal;
};

Demand expected(const SupervisorConditions& c) {
  Demand demand;
  const auto ask = [&demand](bool condition, SafetyState state, bool stays) {
    if (!condition) return;
    demand.now = std::max(demand.now, state);
    if (stays) demand.stays = std::max(demand.stays, state);
  };
  const bool seen = c.pose_age_s <= 0.05;
  ask(c.kill, SafetyState::kCut, true);
  if (c.phase == FlightPhase::kIdle || c.phase == FlightPhase::kOff) return demand;
  ask(c.pose_age_s > 0.05, SafetyState::kCoasting, false);
  ask(c.pose_age_s > 0.15, SafetyState::kNeutral, false);
  ask(c.pose_age_s > 0.5, SafetyState::kDescending, false);
  ask(c.health.live_cameras == 0, SafetyState::kNeutral, false);
  ask(c.lift_off_failed, SafetyState::kCut, true);
  ask(c.health.transmitter_fault && !c.health.transmitter_ready, SafetyState::kCut, true);
  ask(c.health.transmitter_fault, SafetyState::kLandNow, true);
  ask(c.health.transmitter_fault, SafetyState::kCut, true);
  ask(seen && c.tilt > 1.047, SafetyState::kCut, true);
  if (c.phase != FlightPhase::kFlying && c.phase != FlightPhase::kLanding) return demand;
  ask(c.flight_time_s > 600.0, SafetyState::kLandNow, true);
  ask(seen && c.place.head<2>().norm() > 1.5, SafetyState::kLandNow, true);
  ask(seen && c.place.head<2>().norm() > 2.0, SafetyState::kCut, true);
  ask(seen && c.speed > 2.5, SafetyState::kLandNow, true);
  ask(seen && c.health.position_sigma > 0.05, SafetyState::kHolding, false);
  return demand;
}

SupervisorMemory held(const SupervisorMemory& from, SupervisorConditions c, TimeNs& now) {
  SupervisorMemory memory = from;
  for (const TimeNs end = now + fromSeconds(kLong); now <= end;) {
    now += fromSeconds(kTick);
    c.now = now;
    memory = supervise({}, memory, c);
  }
  return memory;
}

/// Calls `use` with every combination in which each part of the conditions takes each of its values.
template <class Use>
void forEveryCombination(FlightPhase phase, const Use& use) {
  for (const double age : {0.01, 0.1, 0.2, 0.6})
    for (const double tilt : {0.1, 1.2})
      for (const double aside : {0.0, 1.4, 1.6, 2.1})
        for (const double time : {10.0, 550.0, 601.0})
          for (int bits = 0; bits < 64; ++bits) {
            SupervisorConditions c = quiet(phase);
            c.pose_age_s = age;
            c.tilt = tilt;
            c.place.x() = aside;
            c.flight_time_s = time;
            c.kill = (bits & 1) != 0;
            c.lift_off_failed = (bits & 2) != 0;
            c.health.live_cameras = (bits & 4) != 0 ? 0 : 2;
            c.health.transmitter_fault = (bits & 8) != 0;
            c.health.position_sigma = (bits & 16) != 0 ? 0.06 : 0.001;
            c.speed = (bits & 32) != 0 ? 2.6 : 0.2;
            use(c);
          }
}

TEST(SupervisorTransitions, EveryCombinationOfConditionsDemandsWhatTheTableSays) {
  for (const FlightPhase phase : test::kPhases)
    forEveryCombination(phase, [phase](const SupervisorConditions& c) {
      TimeNs now = 0;
      const SupervisorMemory memory = held({}, c, now);
      ASSERT_EQ(memory.state, expected(c).now)
          << toString(phase) << ", age " << c.pose_age_s << ", tilt " << c.tilt << ", aside " << c.place.x()
          << ", time " << c.flight_time_s << ", kill " << c.kill << ", lift-off failed " << c.lift_off_failed
          << ", cameras " << c.health.live_cameras << ", fault " << c.health.transmitter_fault << ", sigma "
          << c.health.position_sigma << ", speed " << c.speed;
    });
}

/// All well, and each trigger alone.
std::vector<SupervisorConditions> singleTriggers(FlightPhase phase) {
  std::vector<SupervisorConditions> all(1, quiet(phase));
  const auto add = [&](auto&& bring) { bring(all.emplace_back(quiet(phase))); };
  for (const double age : {0.1, 0.2, 0.6}) add([age](auto& c) { c.pose_age_s = age; });
  for (const double aside : {1.4, 1.6, 2.1}) add([aside](auto& c) { c.place.y() = -aside; });
  for (const double time : {550.0, 601.0}) add([time](auto& c) { c.flight_time_s = time; });
  add([](auto& c) { c.tilt = 1.2; });
  add([](auto& c) { c.kill = true; });
  add([](auto& c) { c.lift_off_failed = true; });
  add([](auto& c) { c.health.live_cameras = 0; });
  add([](auto& c) { c.health.transmitter_fault = true; });
  add([](auto& c) {
    c.health.transmitter_fault = true;
    c.health.transmitter_ready = false;
  });
  add([](auto& c) { c.health.position_sigma = 0.06; });
  add([](auto& c) { c.speed = 2.6; });
  return all;
}

/// Blind all the time: a descent that began on the ground is the shortest, and over by the end.
bool descentIsOver(const SupervisorConditions& before, const SupervisorConditions& after) {
  return before.pose_age_s > 0.5 && after.pose_age_s > 0.5 && rotorsTurn(before.phase) &&
         rotorsTurn(after.phase) && !inTheAir(before.phase);
}

/// Doubt all the time lands in the end.
bool doubtIsLong(const SupervisorConditions& before, const SupervisorConditions& after) {
  return before.health.position_sigma > 0.05 && after.health.position_sigma > 0.05 &&
         inTheAir(before.phase) && inTheAir(after.phase);
}

TEST(SupervisorTransitions, FromEveryConditionToEveryOtherInEveryPhase) {
  for (const FlightPhase phase_before : test::kPhases)
    for (const auto& before : singleTriggers(phase_before)) {
      TimeNs then = 0;
      const SupervisorMemory reached = held({}, before, then);
      for (const FlightPhase phase : test::kPhases)
        for (const auto& after : singleTriggers(phase)) {
          TimeNs now = then;
          const SupervisorMemory memory = held(reached, after, now);
          SafetyState state = std::max(expected(before).stays, expected(after).now);
          if (doubtIsLong(before, after)) state = std::max(state, SafetyState::kLandNow);
          if (descentIsOver(before, after)) state = SafetyState::kCut;
          ASSERT_EQ(memory.state, state) << "from " << toString(phase_before) << " to " << toString(phase);
          ASSERT_EQ(memory.failsafes & reached.failsafes, reached.failsafes);
        }
    }
}

}  // namespace
}  // namespace helical
