#pragma once

#include <cmath>
#include <cstdint>

namespace helical {

/// Time on one monotonic clock, in nanoseconds. Frames are stamped at mid-exposure on this clock.
using TimeNs = std::int64_t;

inline constexpr TimeNs kNanosecondsPerSecond = 1'000'000'000;
inline constexpr TimeNs kNanosecondsPerMillisecond = 1'000'000;

constexpr double toSeconds(TimeNs time) {
  return static_cast<double>(time) * 1e-9;
}
inline TimeNs fromSeconds(double seconds) {
  return static_cast<TimeNs>(std::llround(seconds * 1e9));
}

}  // namespace helical
