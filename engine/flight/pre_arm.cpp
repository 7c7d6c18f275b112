#include "engine/flight/pre_arm.h"

#include "engine/flight/fence.h"

namespace helical {
namespace {

constexpr double kPadRadius = 0.5;      // m, within which it may start
constexpr double kPadTolerance = 0.06;  // m, of its height above the ground
constexpr double kStartTilt = 0.2;      // rad

}  // namespace

std::uint32_t failingChecks(const SupervisorOptions& o, SafetyState state, const SupervisorConditions& c) {
  const SystemHealth& health = c.health;
  const struct {
    PreArmCheck check;
    bool passes;
  } checks[] = {
      {PreArmCheck::kCut, state != SafetyState::kCut && !c.kill},
      {PreArmCheck::kFlightOver, c.phase == FlightPhase::kIdle},
      {PreArmCheck::kPose, c.pose_known && c.pose_age_s <= o.coast_after_s},
      {PreArmCheck::kPad, c.place.head<2>().norm() <= kPadRadius && c.standing_error <= kPadTolerance &&
                              c.standing_error >= -kPadTolerance},
      {PreArmCheck::kUpright, c.tilt <= kStartTilt},
      {PreArmCheck::kStill, c.drift <= o.arm_speed},
      {PreArmCheck::kFence, beyondFence(o, c.place) <= 0.0},
      {PreArmCheck::kCameras, health.live_cameras >= o.arm_cameras},
      {PreArmCheck::kFrameRate, health.frame_share >= o.arm_rate_share},
      {PreArmCheck::kResidual, health.residual_ratio <= o.residual_limit && !health.cameras_disagree},
      {PreArmCheck::kCovariance,
       health.position_sigma <= o.position_sigma_limit && health.rotation_sigma <= o.rotation_sigma_limit},
      {PreArmCheck::kYaw, !health.yaw_ambiguous},
      {PreArmCheck::kTransmitter, health.transmitter_ready && !health.transmitter_fault},
      {PreArmCheck::kChannels, health.channels_calibrated},
      {PreArmCheck::kPilot, !health.pilot_flies},
      {PreArmCheck::kSticks, c.sticks_idle},
      {PreArmCheck::kRecord, !health.record_failed && !health.record_stalled},
      {PreArmCheck::kDisk, health.disk_free_gb >= o.arm_disk_gb},
      {PreArmCheck::kCpu, health.tick_share >= o.arm_rate_share},
  };
  std::uint32_t failing = 0;
  // Written so that what is not a number fails.
  for (const auto& [check, passes] : checks)
    if (!passes) failing |= bitOf(check);
  return failing;
}

const char* firstReason(std::uint32_t failing) {
  return failing == 0 ? nullptr : toString(static_cast<PreArmCheck>(failing & (~failing + 1)));
}

}  // namespace helical
