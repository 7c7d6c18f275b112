#include "engine/transmitter/transmitter_options.h"

#include "engine/base/error.h"

namespace helical {

std::array<std::string_view, 4> transmitterKinds() {
  return {"simulated", "output-process", "loopback", "none"};
}

void validate(const TransmitterOptions& options) {
  validate(options.guard);
  if (!(options.rate_hz >= 50.0 && options.rate_hz <= 500.0))
    throw Error(ErrorKind::kInput, "rate_hz is " + std::to_string(options.rate_hz), {}, "give 50 to 500 Hz");
}

}  // namespace helical
