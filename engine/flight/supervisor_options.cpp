#include "engine/flight/supervisor_options.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "engine/base/error.h"

namespace helical {

void validate(const SupervisorOptions& o) {
  const std::pair<const char*, double> limits[] = {
      {"coast_after_s", o.coast_after_s},
      {"neutral_after_s", o.neutral_after_s},
      {"descend_after_s", o.descend_after_s},
      {"descent_speed", o.descent_speed},
      {"longest_descent_s", o.longest_descent_s},
      {"tilt_limit", o.tilt_limit},
      {"tilt_time_s", o.tilt_time_s},
      {"speed_limit", o.speed_limit},
      {"speed_time_s", o.speed_time_s},
      {"fence_radius", o.fence_radius},
      {"fence_half_x", o.fence_half_x},
      {"fence_half_y", o.fence_half_y},
      {"fence_height", o.fence_height},
      {"fence_warning_margin", o.fence_warning_margin},
      {"hard_fence_margin", o.hard_fence_margin},
      {"flight_time_limit_s", o.flight_time_limit_s},
      {"residual_limit", o.residual_limit},
      {"position_sigma_limit", o.position_sigma_limit},
      {"rotation_sigma_limit", o.rotation_sigma_limit},
      {"uncertain_after_s", o.uncertain_after_s},
      {"uncertain_land_s", o.uncertain_land_s},
      {"camera_silent_s", o.camera_silent_s},
      {"camera_clock_s", o.camera_clock_s},
      {"overrun_s", o.overrun_s},
      {"transmitter_fault_s", o.transmitter_fault_s},
      {"transmitter_cut_s", o.transmitter_cut_s},
      {"record_stalled_s", o.record_stalled_s},
      {"arm_cameras", o.arm_cameras},
      {"arm_rate_share", o.arm_rate_share},
      {"arm_speed", o.arm_speed},
      {"arm_disk_gb", o.arm_disk_gb},
      {"disarm_idle_s", o.disarm_idle_s},
      {"disarm_after_cut_s", o.disarm_after_cut_s},
  };
  for (const auto& [key, value] : limits)
    if (!(value > 0.0) || !std::isfinite(value))
      throw Error(ErrorKind::kInput, std::string(key) + " is " + std::to_string(value), {},
                  "give a number above 0");
  if (o.descend_after_s <= o.neutral_after_s)
    throw Error(ErrorKind::kInput, "descend_after_s is not longer than neutral_after_s", {},
                "a descent follows neutral sticks: give a longer time");
  if (o.neutral_after_s <= o.coast_after_s)
    throw Error(ErrorKind::kInput, "neutral_after_s is not longer than coast_after_s", {},
                "neutral sticks follow a coast: give a longer time");
  if (o.transmitter_cut_s <= o.transmitter_fault_s)
    throw Error(ErrorKind::kInput, "transmitter_cut_s is not longer than transmitter_fault_s", {},
                "it is to land before it is cut: give a longer time");
  const double narrowest = o.fence == FenceShape::kCylinder
                               ? std::min(o.fence_radius, o.fence_height)
                               : std::min({o.fence_half_x, o.fence_half_y, o.fence_height});
  if (o.fence_warning_margin >= narrowest)
    throw Error(ErrorKind::kInput, "fence_warning_margin leaves no room inside the fence", {},
                "give a smaller margin or a wider fence");
  if (o.arm_rate_share > 1.0)
    throw Error(ErrorKind::kInput, "arm_rate_share is above 1", {}, "give a share of what should come");
}

}  // namespace helical
