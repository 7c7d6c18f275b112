#include "engine/base/clock.h"

#include <cerrno>
#include <ctime>

namespace helical {
namespace {

TimeNs read(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<TimeNs>(time.tv_sec) * kNanosecondsPerSecond + time.tv_nsec;
}

}  // namespace

MonotonicClock::MonotonicClock() : origin_(read(CLOCK_MONOTONIC)) {}

void MonotonicClock::restart() {
  origin_ = read(CLOCK_MONOTONIC);
}

TimeNs MonotonicClock::now() const {
  return read(CLOCK_MONOTONIC) - origin_;
}

void MonotonicClock::sleepUntil(TimeNs time) {
  const TimeNs absolute = time + origin_;
  const timespec until{absolute / kNanosecondsPerSecond, absolute % kNanosecondsPerSecond};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

TimeNs threadCpuTime() {
  return read(CLOCK_THREAD_CPUTIME_ID);
}

}  // namespace helical
