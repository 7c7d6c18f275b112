#include "engine/base/monotonic.h"

#include <cerrno>
#include <ctime>

namespace helical {

TimeNs monotonicNow() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<TimeNs>(time.tv_sec) * kNanosecondsPerSecond + time.tv_nsec;
}

void sleepUntilMonotonic(TimeNs time) {
  const timespec until{time / kNanosecondsPerSecond, time % kNanosecondsPerSecond};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

}  // namespace helical
