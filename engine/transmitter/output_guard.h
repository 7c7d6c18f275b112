#pragma once

#include "engine/base/time.h"
#include "engine/helicopter/stick_demand.h"

namespace helical {

/// What the output does when nobody tells it anything any more.
struct OutputGuardOptions {
  double silent_s = 0.1;    ///< an older demand is not flown: the swash plate goes neutral
  double hold_s = 0.4;      ///< rotors as they were, then
  double ramp_per_s = 0.5;  ///< share of their throttle taken away per second
};

/// Throws Error(kInput) naming the offending key.
void validate(const OutputGuardOptions& options);

/// Decides what may leave from the newest demand and its age. What was ramped down, or never unlocked, is
/// locked: only a fresh demand with the rotors at rest unlocks it, so that nothing spins up by itself when
/// the flight thread, the ground station or this process comes back. One thread.
class OutputGuard {
 public:
  explicit OutputGuard(const OutputGuardOptions& options, bool locked = true);

  /// `newest` was made at `made`, on the same clock as `now`. One that is no number counts as not made.
  StickDemand step(const StickDemand& newest, TimeNs made, TimeNs now);
  bool locked() const { return locked_; }
  /// The device was away: what comes back finds the rotors at rest.
  void lock() { locked_ = true; }

 private:
  StickDemand neutralRamp(TimeNs silent_for) const;

  OutputGuardOptions options_;
  bool locked_;
  StickDemand flown_;  ///< the last fresh one
  TimeNs sound_at_ = 0;  ///< when the newest demand was made that was one
};

}  // namespace helical
