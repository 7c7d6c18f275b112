#include "engine/flight/supervisor.h"

#include <algorithm>

namespace helical {
namespace {

SupervisorMemory cut(SupervisorMemory memory, Failsafe reason) {
  memory.state = SafetyState::kCut;
  memory.failsafes |= static_cast<std::uint32_t>(reason);
  return memory;
}

/// Coasting and descending, from the age of the pose; leaves the other states alone.
SupervisorMemory withoutPose(const SupervisorOptions& options, SupervisorMemory memory,
                             const SupervisorConditions& c) {
  const auto raise = [&](Failsafe reason) { memory.failsafes |= static_cast<std::uint32_t>(reason); };
  if (c.pose_age_s <= options.coast_after_s) {
    if (memory.state == SafetyState::kCoasting || memory.state == SafetyState::kDescending)
      memory.state = SafetyState::kNormal;
    memory.descending_since = -1;
    return memory;
  }
  if (c.pose_age_s <= options.descend_after_s) {
    if (memory.state == SafetyState::kNormal) memory.state = SafetyState::kCoasting;
    raise(Failsafe::kNoPoseCoast);
    return memory;
  }
  if (memory.descending_since < 0) {
    memory.descending_since = c.now;
    memory.descent_s =
        std::min(options.longest_descent_s, c.height_above_pad / options.descent_speed + kSettleOnSkids);
  }
  memory.state = SafetyState::kDescending;
  raise(Failsafe::kNoPoseDescent);
  if (toSeconds(c.now - memory.descending_since) > memory.descent_s) return cut(memory, Failsafe::kNoPoseCut);
  return memory;
}

}  // namespace

SupervisorMemory supervise(const SupervisorOptions& options, const SupervisorMemory& before,
                           const SupervisorConditions& c) {
  if (c.kill) return cut(before, Failsafe::kKill);
  if (before.state == SafetyState::kCut || !rotorsTurn(c.phase)) return before;
  SupervisorMemory memory = before;
  const bool pose_is_fresh = c.pose_age_s <= options.coast_after_s;

  // Tilt and place mean something only while there is a pose.
  if (pose_is_fresh && c.tilt > options.tilt_limit) {
    if (memory.tilted_since < 0) memory.tilted_since = c.now;
    if (toSeconds(c.now - memory.tilted_since) > options.tilt_time_s) return cut(memory, Failsafe::kTilt);
  } else {
    memory.tilted_since = -1;
  }
  if (c.lift_off_failed) return cut(memory, Failsafe::kLiftOffFailed);
  if (inTheAir(c.phase) && pose_is_fresh) {
    const double beyond =
        std::max(c.distance_from_pad - options.fence_radius, c.height_above_pad - options.fence_height);
    if (beyond > options.hard_fence_margin) return cut(memory, Failsafe::kHardFence);
    if (beyond > 0.0) {
      memory.state = SafetyState::kLandNow;
      memory.failsafes |= static_cast<std::uint32_t>(Failsafe::kFence);
    }
  }
  if (c.flight_time_s > options.flight_time_limit_s && inTheAir(c.phase)) {
    if (memory.state == SafetyState::kNormal) memory.state = SafetyState::kLandNow;
    memory.failsafes |= static_cast<std::uint32_t>(Failsafe::kFlightTime);
  }
  return withoutPose(options, memory, c);
}

}  // namespace helical
