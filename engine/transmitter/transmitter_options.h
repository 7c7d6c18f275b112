#pragma once

#include <array>
#include <string>
#include <string_view>

#include "engine/transmitter/output_guard.h"

namespace helical {

/// The transmitter that a rig names.
struct TransmitterOptions {
  /// "simulated"; "output-process": the simulated one behind the output process; "loopback": the helicopter
  /// of `helical serve`; "none": a rig that only looks on.
  std::string kind = "simulated";
  std::string device;  ///< of the output process: the file that it writes its output down in, or nothing
  std::string address = "127.0.0.1:5391";  ///< of the loopback: where `helical serve` listens
  double rate_hz = 100.0;  ///< of the output process
  OutputGuardOptions guard;
};

/// What `kind` may be.
std::array<std::string_view, 4> transmitterKinds();

/// Throws Error(kInput) naming the offending key.
void validate(const TransmitterOptions& options);

}  // namespace helical
