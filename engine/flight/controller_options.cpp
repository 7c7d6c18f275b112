#include "engine/flight/controller_options.h"

#include <cmath>
#include <string>
#include <utility>

#include "engine/base/error.h"

namespace helical {
namespace {

using O = ControllerOptions;
constexpr ControllerKey kKeys[] = {
    {"position_p", &O::position_p, 0.6, 3.0, "1/m"},
    {"position_d", &O::position_d, 1.0, 3.2, "s/m"},
    {"position_i", &O::position_i, 0.0, 1.2, "1/(m s)"},
    {"position_i_limit", &O::position_i_limit, 0.0, 0.6, ""},
    {"position_error_limit", &O::position_error_limit, 0.1, 1.0, "m"},
    {"tilt", &O::tilt, 1.0, 3.0, "1/rad"},
    {"phase", &O::phase, -0.3, 0.6, "rad"},
    {"height_p", &O::height_p, 0.08, 0.4, "1/m"},
    {"height_d", &O::height_d, 0.06, 0.25, "s/m"},
    {"height_i", &O::height_i, 0.0, 0.3, "1/(m s)"},
    {"yaw_p", &O::yaw_p, 0.4, 3.0, "1/s"},
    {"yaw_rate_limit", &O::yaw_rate_limit, 0.2, 1.6, "rad/s"},
    {"yaw_d", &O::yaw_d, 0.002, 0.015, "s/rad"},
    {"yaw_i", &O::yaw_i, 0.0, 0.02, "1/rad"},
    {"trim_upper", &O::trim_upper, -0.1, 0.1, ""},
    {"trim_lower", &O::trim_lower, -0.1, 0.1, ""},
    {"trim_roll", &O::trim_roll, -0.2, 0.2, ""},
    {"trim_pitch", &O::trim_pitch, -0.2, 0.2, ""},
};

}  // namespace

std::span<const ControllerKey> controllerKeys() {
  return kKeys;
}

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
  const std::pair<const char*, double> trims[] = {{"trim_upper", o.trim_upper},
                                                  {"trim_lower", o.trim_lower},
                                                  {"trim_roll", o.trim_roll},
                                                  {"trim_pitch", o.trim_pitch}};
  for (const auto& [key, value] : trims)
    if (!(std::abs(value) <= 0.5))
      throw Error(ErrorKind::kInput, std::string(key) + " is " + std::to_string(value), {},
                  "give -0.5 to 0.5");
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
