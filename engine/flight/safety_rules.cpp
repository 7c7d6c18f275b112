#include "engine/flight/fence.h"
#include "engine/flight/supervisor.h"

namespace helical {
namespace {

using Options = SupervisorOptions;
using Memory = SupervisorMemory;
using Conditions = SupervisorConditions;
using Scope = SafetyRule::Scope;

constexpr double kWarnedShare = 0.9;         // of the flight time
constexpr double kClearedShare = 1.0 / 2.5;  // of a limit: below it a doubt is over
constexpr int kLateTicks = 3;

bool doubtful(const Options& o, const Conditions& c, double share) {
  const SystemHealth& health = c.health;
  return health.residual_ratio > share * o.residual_limit ||
         health.position_sigma > share * o.position_sigma_limit ||
         health.rotation_sigma > share * o.rotation_sigma_limit;
}

bool poseIsOlder(double than_s, const Conditions& c) {
  return c.pose_age_s > than_s;
}

bool poseWillBeOlder(double than_s, const Conditions& c) {
  return c.pose_age_s + c.period_s > than_s;
}

constexpr std::array<SafetyRule, kFailsafeCount> kRules{{
    {Failsafe::kNoPoseCoast, Scope::kRotorsTurn, false,
     [](const Options& o, const Memory&, const Conditions& c) { return poseWillBeOlder(o.coast_after_s, c); },
     nullptr, SafetyState::kCoasting, false, nullptr},
    {Failsafe::kNoPoseDescent, Scope::kRotorsTurn, false,
     [](const Options& o, const Memory&, const Conditions& c) { return poseIsOlder(o.descend_after_s, c); },
     nullptr, SafetyState::kDescending, false, nullptr},
    {Failsafe::kNoPoseCut, Scope::kRotorsTurn, false,
     [](const Options&, const Memory& m, const Conditions& c) {
       return m.descending_since >= 0 && toSeconds(c.now - m.descending_since) > m.descent_s;
     },
     nullptr, SafetyState::kCut, true, nullptr},
    {Failsafe::kTilt, Scope::kRotorsTurn, true,
     [](const Options& o, const Memory&, const Conditions& c) { return c.tilt > o.tilt_limit; },
     &Options::tilt_time_s, SafetyState::kCut, true, nullptr},
    {Failsafe::kFence, Scope::kInTheAir, true,
     [](const Options& o, const Memory&, const Conditions& c) { return beyondFence(o, c.place) > 0.0; },
     nullptr, SafetyState::kLandNow, true, nullptr},
    {Failsafe::kHardFence, Scope::kInTheAir, true,
     [](const Options& o, const Memory&, const Conditions& c) {
       return beyondFence(o, c.place) > o.hard_fence_margin;
     },
     nullptr, SafetyState::kCut, true, nullptr},
    {Failsafe::kFlightTime, Scope::kInTheAir, false,
     [](const Options& o, const Memory&, const Conditions& c) {
       return c.flight_time_s > o.flight_time_limit_s;
     },
     nullptr, SafetyState::kLandNow, true, nullptr},
    {Failsafe::kKill, Scope::kAlways, false,
     [](const Options&, const Memory&, const Conditions& c) { return c.kill; }, nullptr, SafetyState::kCut,
     true, nullptr},
    {Failsafe::kLiftOffFailed, Scope::kRotorsTurn, false,
     [](const Options&, const Memory&, const Conditions& c) { return c.lift_off_failed; }, nullptr,
     SafetyState::kCut, true, nullptr},
    {Failsafe::kNoPoseNeutral, Scope::kRotorsTurn, false,
     [](const Options& o, const Memory&, const Conditions& c) { return poseIsOlder(o.neutral_after_s, c); },
     nullptr, SafetyState::kNeutral, false, nullptr},
    {Failsafe::kFewCameras, Scope::kRotorsTurn, false,
     [](const Options&, const Memory&, const Conditions& c) { return c.health.live_cameras < 1; },
     &Options::neutral_after_s, SafetyState::kNeutral, false, nullptr},
    {Failsafe::kUncertain, Scope::kInTheAir, true,
     [](const Options& o, const Memory&, const Conditions& c) { return doubtful(o, c, 1.0); },
     &Options::uncertain_after_s, SafetyState::kHolding, false,
     [](const Options& o, const Memory&, const Conditions& c) { return doubtful(o, c, kClearedShare); }},
    {Failsafe::kUncertainLand, Scope::kInTheAir, true,
     [](const Options&, const Memory& m, const Conditions&) {
       return (m.alarms & bitOf(Failsafe::kUncertain)) != 0;
     },
     &Options::uncertain_land_s, SafetyState::kLandNow, true, nullptr},
    {Failsafe::kSpeed, Scope::kInTheAir, true,
     [](const Options& o, const Memory&, const Conditions& c) { return c.speed > o.speed_limit; },
     &Options::speed_time_s, SafetyState::kLandNow, true, nullptr},
    {Failsafe::kTransmitterLost, Scope::kRotorsTurn, false,
     [](const Options&, const Memory&, const Conditions& c) {
       return c.health.transmitter_fault && !c.health.transmitter_ready;
     },
     &Options::transmitter_fault_s, SafetyState::kCut, true, nullptr},
    {Failsafe::kFenceNear, Scope::kInTheAir, true,
     [](const Options& o, const Memory&, const Conditions& c) {
       return beyondFence(o, c.place) > -o.fence_warning_margin;
     },
     nullptr, SafetyState::kNormal, false, nullptr},
    {Failsafe::kFlightTimeSoon, Scope::kInTheAir, false,
     [](const Options& o, const Memory&, const Conditions& c) {
       return c.flight_time_s > kWarnedShare * o.flight_time_limit_s;
     },
     nullptr, SafetyState::kNormal, false, nullptr},
    {Failsafe::kCameraSilent, Scope::kAlways, false,
     [](const Options&, const Memory&, const Conditions& c) { return c.health.camera_silent; }, nullptr,
     SafetyState::kNormal, false, nullptr},
    {Failsafe::kCameraClock, Scope::kAlways, false,
     [](const Options&, const Memory&, const Conditions& c) { return c.health.camera_clock_off; },
     &Options::camera_clock_s, SafetyState::kNormal, false, nullptr},
    {Failsafe::kOverrun, Scope::kAlways, false,
     [](const Options&, const Memory& m, const Conditions&) { return m.late_ticks >= kLateTicks; }, nullptr,
     SafetyState::kNormal, false, nullptr},
    {Failsafe::kTransmitterFault, Scope::kAlways, false,
     [](const Options&, const Memory&, const Conditions& c) {
       return c.health.transmitter_fault || !c.health.transmitter_ready;
     },
     nullptr, SafetyState::kNormal, false, nullptr},
    {Failsafe::kPilotFlies, Scope::kAlways, false,
     [](const Options&, const Memory&, const Conditions& c) { return c.health.pilot_flies; }, nullptr,
     SafetyState::kNormal, false, nullptr},
    {Failsafe::kRecord, Scope::kAlways, false,
     [](const Options&, const Memory&, const Conditions& c) {
       return c.health.record_failed || c.health.record_stalled;
     },
     &Options::record_stalled_s, SafetyState::kNormal, false, nullptr},
    {Failsafe::kTransmitterStalled, Scope::kRotorsTurn, false,
     [](const Options&, const Memory&, const Conditions& c) { return c.health.transmitter_fault; },
     &Options::transmitter_fault_s, SafetyState::kLandNow, true, nullptr},
    {Failsafe::kTransmitterSilent, Scope::kRotorsTurn, false,
     [](const Options&, const Memory&, const Conditions& c) { return c.health.transmitter_fault; },
     &Options::transmitter_cut_s, SafetyState::kCut, true, nullptr},
}};

constexpr bool inTheirOrder() {
  for (std::size_t i = 0; i < kRules.size(); ++i)
    if (bitOf(kRules[i].failsafe) != 1u << i) return false;
  return true;
}
static_assert(inTheirOrder());

constexpr bool everyCutStays() {
  for (const SafetyRule& rule : kRules)
    if (rule.demands == SafetyState::kCut && !rule.stays) return false;
  return true;
}
static_assert(everyCutStays());

}  // namespace

const std::array<SafetyRule, kFailsafeCount>& safetyRules() {
  return kRules;
}

}  // namespace helical
