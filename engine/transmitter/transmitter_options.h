#pragma once

#include <string>

#include "engine/transmitter/output_guard.h"

namespace helical {

/// The transmitter that a rig names.
struct TransmitterOptions {
  std::string kind = "simulated";  ///< or "loopback": the simulated one behind the output process
  std::string device;      ///< of the loopback: the file that it writes its output down in, or nothing
  double rate_hz = 100.0;  ///< of the output process
  OutputGuardOptions guard;
};

/// Throws Error(kInput) naming the offending key.
void validate(const TransmitterOptions& options);

}  // namespace helical
