#include "engine/transmitter/transmitter_options.h"

#include "engine/base/error.h"

namespace helical {

void validate(const TransmitterOptions& options) {
  validate(options.guard);
  if (!(options.rate_hz >= 50.0 && options.rate_hz <= 500.0))
    throw Error(ErrorKind::kInput, "rate_hz is " + std::to_string(options.rate_hz), {}, "give 50 to 500 Hz");
}

}  // namespace helical
