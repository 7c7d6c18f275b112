#include "engine/transmitter/output_guard.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "engine/base/error.h"

namespace helical {
namespace {

bool rotorsRest(const StickDemand& demand) {
  return demand.upper_rotor <= 0.0 && demand.lower_rotor <= 0.0;
}

bool isFinite(const StickDemand& demand) {
  return std::isfinite(demand.upper_rotor) && std::isfinite(demand.lower_rotor) && std::isfinite(demand.roll) &&
         std::isfinite(demand.pitch);
}

}  // namespace

void validate(const OutputGuardOptions& o) {
  const std::pair<const char*, double> limits[] = {
      {"silent_s", o.silent_s}, {"hold_s", o.hold_s}, {"ramp_per_s", o.ramp_per_s}};
  for (const auto& [key, value] : limits)
    if (!(value > 0.0) || !std::isfinite(value))
      throw Error(ErrorKind::kInput, std::string(key) + " is " + std::to_string(value), {},
                  "give a number above 0");
}

OutputGuard::OutputGuard(const OutputGuardOptions& options, bool locked)
    : options_(options), locked_(locked) {}

StickDemand OutputGuard::neutralRamp(TimeNs silent_for) const {
  const double ramp =
      options_.ramp_per_s * std::max(0.0, toSeconds(silent_for) - options_.silent_s - options_.hold_s);
  const double keep = std::max(0.0, 1.0 - ramp);
  return {keep * flown_.upper_rotor, keep * flown_.lower_rotor, 0.0, 0.0};
}

StickDemand OutputGuard::step(const StickDemand& newest, TimeNs made, TimeNs now) {
  // What is no number is no demand, and the last one that was grows old.
  const bool sound = isFinite(newest);
  if (sound) sound_at_ = made;
  const TimeNs silent_for = now - sound_at_;
  const bool fresh = sound && toSeconds(silent_for) <= options_.silent_s;
  if (locked_) {
    locked_ = !fresh || !rotorsRest(newest);
    flown_ = {};
    return {};
  }
  if (fresh) return flown_ = newest;
  const StickDemand demand = neutralRamp(silent_for);
  if (!rotorsRest(flown_) && rotorsRest(demand)) locked_ = true;
  return demand;
}

}  // namespace helical
