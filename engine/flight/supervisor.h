#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "engine/flight/flight_state.h"
#include "engine/flight/supervisor_options.h"
#include "engine/flight/system_health.h"

namespace helical {

/// What the supervisor is told at a control tick.
struct SupervisorConditions {
  TimeNs now = 0;
  FlightPhase phase = FlightPhase::kIdle;
  bool pose_known = true;                           ///< was found at least once
  double pose_age_s = 0.0;                          ///< since the last observation that was used
  double period_s = 0.0;                            ///< until the next tick: too late for a limit that passes before
  double climb = 0.0;                               ///< m/s, upwards
  double tilt = 0.0;                                ///< rad
  double speed = 0.0;                               ///< m/s
  double drift = 0.0;                               ///< m/s, of the smoothed pose: what stands still has none
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< from the pad's centre, z above the pad [m]
  double standing_error = 0.0;                      ///< of its height on the pad over the nominal one [m]
  double flight_time_s = 0.0;                       ///< since the rotors started
  bool sticks_idle = true;                          ///< at the last tick
  bool lift_off_failed = false;
  bool arm = false;  ///< orders
  bool disarm = false;
  bool kill = false;
  SystemHealth health;
};

/// An open-loop descent ends this long after it should have reached the ground, in seconds.
inline constexpr double kSettleOnSkids = 1.5;
/// By which it gets down to its speed, or brakes a fall to it [m/s^2].
inline constexpr double kDescentAcceleration = 1.0;

/// What it remembers from tick to tick.
struct SupervisorMemory {
  SafetyState state = SafetyState::kNormal;
  bool armed = false;
  std::uint32_t failsafes = 0;       ///< that have ever acted
  std::uint32_t alarms = 0;          ///< failsafes and warnings that act now
  std::uint32_t failing_checks = 0;  ///< bits of PreArmCheck, now
  std::uint32_t refused = 0;  ///< at the tick of an order to arm that is refused: the checks that failed
  std::array<TimeNs, kFailsafeCount> broken_since = [] {
    std::array<TimeNs, kFailsafeCount> never{};
    never.fill(-1);
    return never;
  }();
  std::uint32_t latched = 0;  ///< failsafes whose demand outlives their cause
  int late_ticks = 0;         ///< in a row
  TimeNs descending_since = -1;
  double descent_s = 0.0;  ///< how long the descent may last, fixed when it begins
  double sink_s = 0.0;     ///< of that, until it has its speed; negative: so long it is braked to it
  TimeNs cut_since = -1;
  TimeNs armed_since = -1;
  TimeNs unfit_since = -1;  ///< armed on the pad, with a check that fails
};

/// One line of the table of triggers.
struct SafetyRule {
  enum class Scope : std::uint8_t { kAlways, kRotorsTurn, kInTheAir };
  using Test = bool (*)(const SupervisorOptions&, const SupervisorMemory&, const SupervisorConditions&);

  Failsafe failsafe;
  Scope scope;
  bool needs_pose;                   ///< without a fresh one it means nothing
  Test broken;                       ///< must hold
  double SupervisorOptions::*for_s;  ///< for longer than this; null: at once
  SafetyState demands;               ///< kNormal: only warns
  bool stays;                        ///< the demand outlives its cause
  Test still_broken;                 ///< once broken, until this is false; null: `broken`
};

/// The table, one rule for each bit of Failsafe in their order.
const std::array<SafetyRule, kFailsafeCount>& safetyRules();

/// The safety state machine: a pure function of memory and conditions, that goes through the table. Kill
/// always wins, cut is latched, what is armed was armed by an order while every check passed. See
/// engine/flight/README.md for the table in words.
SupervisorMemory supervise(const SupervisorOptions& options, const SupervisorMemory& memory,
                           const SupervisorConditions& conditions);

}  // namespace helical
