#include "engine/flight/supervisor_options.h"

#include <cmath>
#include <string>
#include <utility>

#include "engine/base/error.h"

namespace helical {

void validate(const SupervisorOptions& o) {
  const std::pair<const char*, double> limits[] = {{"coast_after_s", o.coast_after_s},
                                                   {"descend_after_s", o.descend_after_s},
                                                   {"descent_speed", o.descent_speed},
                                                   {"longest_descent_s", o.longest_descent_s},
                                                   {"tilt_limit", o.tilt_limit},
                                                   {"tilt_time_s", o.tilt_time_s},
                                                   {"fence_radius", o.fence_radius},
                                                   {"fence_height", o.fence_height},
                                                   {"hard_fence_margin", o.hard_fence_margin},
                                                   {"flight_time_limit_s", o.flight_time_limit_s}};
  for (const auto& [key, value] : limits)
    if (!(value > 0.0) || !std::isfinite(value))
      throw Error(ErrorKind::kInput, std::string(key) + " is " + std::to_string(value), {},
                  "give a number above 0");
  if (o.descend_after_s <= o.coast_after_s)
    throw Error(ErrorKind::kInput, "descend_after_s is not longer than coast_after_s", {},
                "a descent follows a coast: give a longer time");
}

}  // namespace helical
