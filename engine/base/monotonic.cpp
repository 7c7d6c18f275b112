#include "engine/base/monotonic.h"

#include <cerrno>
#include <ctime>

namespace helical {

namespace {

TimeNs timeOf(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<TimeNs>(time.tv_sec) * kNanosecondsPerSecond + time.tv_nsec;
}

}  // namespace

TimeNs monotonicNow() {
  return timeOf(CLOCK_MONOTONIC);
}

TimeNs worldNow() {
  return timeOf(CLOCK_REALTIME);
}

void sleepUntilMonotonic(TimeNs time) {
  const timespec until{time / kNanosecondsPerSecond, time % kNanosecondsPerSecond};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

}  // namespace helical
