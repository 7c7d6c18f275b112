#include "engine/flight/controller_options.h"

#include <cmath>
#include <string>
#include <utility>

#include "engine/base/error.h"

namespace helical {

void validate(const ControllerOptions& o) {
  const std::pair<const char*, double> gains[] = {{"position_p", o.position_p},
                                                  {"position_d", o.position_d},
                                                  {"position_i", o.position_i},
                                                  {"position_i_limit", o.position_i_limit},
                                                  {"position_error_limit", o.position_error_limit},
                                                  {"tilt", o.tilt},
                                                  {"height_p", o.height_p},
                                                  {"height_d", o.height_d},
                                                  {"height_i", o.height_i},
                                                  {"yaw_p", o.yaw_p},
                                                  {"yaw_rate_limit", o.yaw_rate_limit},
                                                  {"yaw_d", o.yaw_d},
                                                  {"yaw_i", o.yaw_i},
                                                  {"ground_yaw_d", o.ground_yaw_d},
                                                  {"ground_yaw_i", o.ground_yaw_i},
                                                  {"output_delay_s", o.output_delay_s}};
  for (const auto& [key, value] : gains)
    if (!(value >= 0.0) || !std::isfinite(value))
      throw Error(ErrorKind::kInput, std::string(key) + " is " + std::to_string(value), {}, "give 0 or more");
  if (!(o.rate_hz >= 20.0 && o.rate_hz <= 500.0))
    throw Error(ErrorKind::kInput, "rate_hz is " + std::to_string(o.rate_hz), {}, "give 20 to 500 Hz");
  if (!(std::abs(o.phase) <= 1.5))
    throw Error(ErrorKind::kInput, "phase is " + std::to_string(o.phase) + " rad", {},
                "give at most 85 degrees");
  if (o.output_delay_s > 0.2)
    throw Error(ErrorKind::kInput, "output_delay_s is " + std::to_string(o.output_delay_s), {},
                "give up to 0.2 s");
}

}  // namespace helical
