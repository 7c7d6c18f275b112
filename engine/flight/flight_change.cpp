#include "engine/flight/flight_change.h"

#include <string>

#include "engine/base/error.h"

namespace helical {

void validate(const FlightChange& change) {
  if (change.plan) validate(*change.plan);
  if (!change.control) return;
  validate(*change.control);
  for (const ControllerKey& key : controllerKeys()) {
    const double value = *change.control.*key.value;
    if (value < key.lowest || value > key.highest)
      throw Error(ErrorKind::kInput, std::string(key.name) + " is " + std::to_string(value), {},
                  "give " + std::to_string(key.lowest) + " to " + std::to_string(key.highest));
  }
}

}  // namespace helical
