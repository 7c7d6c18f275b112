#pragma once

namespace helical {

/// Prints the broken condition and aborts. For programmer errors; users' mistakes are `Error`s.
[[noreturn]] void checkFailed(const char* condition, const char* file, int line);

}  // namespace helical

/// Always on, also in release builds: a flight controller that has lost its invariants must stop.
#define HELICAL_CHECK(condition) \
  (static_cast<bool>(condition) ? void(0) : ::helical::checkFailed(#condition, __FILE__, __LINE__))
