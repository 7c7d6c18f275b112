#include "engine/flight/supervisor.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/flight/pre_arm.h"

namespace helical {
namespace {

constexpr double kUnfitFor = 0.5;  // s with a failing check, after which what is armed on the pad is disarmed

bool inScope(SafetyRule::Scope scope, FlightPhase phase) {
  switch (scope) {
    case SafetyRule::Scope::kAlways:
      return true;
    case SafetyRule::Scope::kRotorsTurn:
      return rotorsTurn(phase);
    case SafetyRule::Scope::kInTheAir:
      return inTheAir(phase);
  }
  return true;
}

constexpr double kFastestClimb = 1.5;  // m/s: more is no velocity of a pose that was lost half a second ago

/// How long a descent may last is fixed when it begins: where it believes to be later means nothing. One that climbs
/// goes on climbing up to an apex, and the way down is from there.
void trackDescent(const SupervisorOptions& options, const SupervisorConditions& c, SupervisorMemory& memory) {
  if (!rotorsTurn(c.phase) || c.pose_age_s <= options.descend_after_s) {
    memory.descending_since = -1;
  } else if (memory.descending_since < 0) {
    memory.descending_since = c.now;
    const double climb = std::isfinite(c.climb) ? std::clamp(c.climb, -kFastestClimb, kFastestClimb) : 0.0;
    const double to_apex_s = std::max(0.0, climb) / kDescentAcceleration;
    const double apex = c.place.z() + 0.5 * to_apex_s * std::max(0.0, climb);
    memory.sink_s = (climb + options.descent_speed) / kDescentAcceleration;
    memory.descent_s =
        std::min(options.longest_descent_s, to_apex_s + apex / options.descent_speed + kSettleOnSkids);
  }
}

bool acts(const SafetyRule& rule, const SupervisorOptions& options, const SupervisorConditions& c,
          const SupervisorMemory& memory, TimeNs& broken_since) {
  const bool pose_is_fresh = c.pose_age_s <= options.coast_after_s;
  const bool was_broken = broken_since >= 0;
  const auto test = was_broken && rule.still_broken != nullptr ? rule.still_broken : rule.broken;
  if (!inScope(rule.scope, c.phase) || (rule.needs_pose && !pose_is_fresh) || !test(options, memory, c)) {
    broken_since = -1;
    return false;
  }
  if (!was_broken) broken_since = c.now;
  return rule.for_s == nullptr || toSeconds(c.now - broken_since) > options.*rule.for_s;
}

void goThroughTable(const SupervisorOptions& options, const SupervisorConditions& c,
                    SupervisorMemory& memory) {
  const auto& rules = safetyRules();
  if (memory.state != SafetyState::kCut) memory.state = SafetyState::kNormal;
  for (std::size_t i = 0; i < rules.size(); ++i) {
    const SafetyRule& rule = rules[i];
    const std::uint32_t bit = bitOf(rule.failsafe);
    const bool acts_now = acts(rule, options, c, memory, memory.broken_since[i]);
    memory.alarms = (memory.alarms & ~bit) | (acts_now ? bit : 0);
    if (acts_now && rule.stays) memory.latched |= bit;
    if (acts_now && rule.demands != SafetyState::kNormal) memory.failsafes |= bit;
    if (acts_now || (memory.latched & bit) != 0) memory.state = std::max(memory.state, rule.demands);
  }
}

/// No limit is ever exceeded by what is no number: a pose that is none counts as no pose, a doubt as the worst.
SupervisorConditions believed(const SupervisorConditions& told) {
  constexpr double kWorst = std::numeric_limits<double>::infinity();
  SupervisorConditions c = told;
  const bool sound =
      c.place.allFinite() && std::isfinite(c.tilt) && std::isfinite(c.speed) && !std::isnan(c.pose_age_s);
  if (!sound) c.pose_age_s = kWorst;
  for (double* doubt : {&c.health.residual_ratio, &c.health.position_sigma, &c.health.rotation_sigma,
                        &c.health.overrun_s, &c.flight_time_s})
    if (std::isnan(*doubt)) *doubt = kWorst;
  return c;
}

bool mayStayArmed(const SupervisorOptions& options, const SupervisorConditions& c, SupervisorMemory& memory) {
  const auto longer = [&c](TimeNs since, double than_s) {
    return since >= 0 && toSeconds(c.now - since) > than_s;
  };
  if (c.phase == FlightPhase::kOff) return false;
  if (longer(memory.cut_since, options.disarm_after_cut_s)) return false;
  if (c.phase != FlightPhase::kIdle) return true;
  if (memory.failing_checks == 0)
    memory.unfit_since = -1;
  else if (memory.unfit_since < 0)
    memory.unfit_since = c.now;
  return !c.disarm && !longer(memory.unfit_since, kUnfitFor) &&
         !longer(memory.armed_since, options.disarm_idle_s);
}

void armOrDisarm(const SupervisorOptions& options, const SupervisorConditions& c, SupervisorMemory& memory) {
  memory.failing_checks = failingChecks(options, memory.state, c);
  memory.refused = 0;
  if (memory.armed) {
    memory.armed = mayStayArmed(options, c, memory);
  } else if (c.arm && !c.disarm) {
    memory.refused = memory.failing_checks;
    memory.armed = memory.failing_checks == 0;
    memory.armed_since = c.now;
    memory.unfit_since = -1;
  }
}

}  // namespace

SupervisorMemory supervise(const SupervisorOptions& options, const SupervisorMemory& before,
                           const SupervisorConditions& told) {
  const SupervisorConditions c = believed(told);
  SupervisorMemory memory = before;
  memory.late_ticks = c.health.overrun_s > options.overrun_s ? before.late_ticks + 1 : 0;
  trackDescent(options, c, memory);
  goThroughTable(options, c, memory);
  if (memory.state == SafetyState::kCut && memory.cut_since < 0) memory.cut_since = c.now;
  armOrDisarm(options, c, memory);
  return memory;
}

}  // namespace helical
