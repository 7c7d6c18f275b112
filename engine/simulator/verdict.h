#pragma once

namespace helical {

/// What has become of a simulated helicopter.
struct Verdict {
  bool crashed = false;
  const char* reason = "";  ///< of the crash
  double crash_time_s = 0.0;
  bool has_flown = false;
  bool at_rest = false;        ///< upright on the ground with rotors almost still
  double hardest_touch = 0.0;  ///< m/s
};

}  // namespace helical
