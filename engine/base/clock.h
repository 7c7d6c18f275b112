#pragma once

#include <atomic>

#include "engine/base/time.h"

namespace helical {

/// The one clock of a flight. Any thread.
class Clock {
 public:
  virtual ~Clock() = default;
  virtual TimeNs now() const = 0;
  /// Returns at `time` or later; at once if `time` has passed. A simulated clock never blocks.
  virtual void sleepUntil(TimeNs time) = 0;
};

/// CLOCK_MONOTONIC, counted from the clock's construction or its last restart.
class MonotonicClock final : public Clock {
 public:
  MonotonicClock();
  TimeNs now() const override;
  void sleepUntil(TimeNs time) override;
  /// Begins again at 0. Only while no other thread uses the clock.
  void restart();

 private:
  TimeNs origin_;
};

/// Simulated time, moved by its owner: the clock of lock-step flights and of tests.
class ManualClock final : public Clock {
 public:
  TimeNs now() const override { return now_.load(std::memory_order_acquire); }
  void sleepUntil(TimeNs) override {}
  void set(TimeNs time) { now_.store(time, std::memory_order_release); }

 private:
  std::atomic<TimeNs> now_{0};
};

/// Processor time of the calling thread: what a step cost, whatever else the machine did.
TimeNs threadCpuTime();

}  // namespace helical
