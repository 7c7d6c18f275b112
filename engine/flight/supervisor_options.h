#pragma once

#include <cstdint>

namespace helical {

enum class FenceShape : std::uint8_t { kCylinder, kBox };

/// Thresholds of the supervisor; they stand beside those of trusted systems in engine/flight/README.md.
struct SupervisorOptions {
  double coast_after_s = 0.05;     ///< without a pose: controller fades to trim
  double neutral_after_s = 0.15;   ///< without a pose: trims alone
  double descend_after_s = 0.5;    ///< without a pose: open-loop descent
  double descent_speed = 0.5;      ///< m/s, of the open-loop descent
  double longest_descent_s = 6.0;  ///< then the rotors are cut, whatever the height

  double tilt_limit = 1.047;  ///< rad (60 degrees)
  double tilt_time_s = 0.3;
  double speed_limit = 2.5;  ///< m/s; faster for `speed_time_s`: land
  double speed_time_s = 0.3;

  FenceShape fence = FenceShape::kCylinder;
  double fence_radius = 1.5;          ///< m from the pad's centre, of the cylinder; beyond: land
  double fence_half_x = 1.5;          ///< m from the pad's centre, of the box
  double fence_half_y = 1.5;          ///< m
  double fence_height = 2.0;          ///< m above the pad
  double fence_warning_margin = 0.2;  ///< m inside the fence; nearer: pushed back
  double hard_fence_margin = 0.5;     ///< m beyond the fence: cut

  double flight_time_limit_s = 600.0;  ///< then it lands

  double residual_limit = 3.0;          ///< times its baseline
  double position_sigma_limit = 0.05;   ///< m, of the pose
  double rotation_sigma_limit = 0.262;  ///< rad (15 degrees), of the pose
  double uncertain_after_s = 0.5;       ///< beyond one of these three: hold
  double uncertain_land_s = 1.0;        ///< of holding: land

  double camera_silent_s = 0.1;
  double camera_clock_s = 0.5;
  double overrun_s = 0.010;          ///< of a control tick, three in a row: warn
  double transmitter_fault_s = 0.1;  ///< gone: cut, latched; there but not answering: lands
  double transmitter_cut_s = 0.5;    ///< not answering: cut, latched
  double record_stalled_s = 0.8;

  double arm_cameras = 2.0;      ///< live and calibrated, at least
  double arm_rate_share = 0.95;  ///< of the frames and control ticks that should have come
  double arm_speed = 0.05;       ///< m/s: the pose stands still
  double arm_disk_gb = 1.0;      ///< free for the record
  double disarm_idle_s = 60.0;   ///< armed on the pad without taking off
  double disarm_after_cut_s = 5.0;
};

/// Throws Error(kInput) naming the offending key.
void validate(const SupervisorOptions& options);

}  // namespace helical
