#pragma once

#include <atomic>

#include "engine/base/latest_value.h"
#include "engine/base/time.h"
#include "engine/transmitter/output_guard.h"
#include "engine/transmitter/transmitter.h"

namespace helical {

/// Stands between the flight thread and the transmitter, on a clock of its own. Sends the newest demand; when
/// the flight thread falls silent it goes neutral, then ramps the rotors down, and does not start them again.
/// Kill bypasses the queue: it acts at the next `step`, whatever the flight thread does.
class OutputLoop {
 public:
  explicit OutputLoop(Transmitter& transmitter, const OutputGuardOptions& options = {})
      : transmitter_(transmitter), guard_(options, false) {}

  /// Flight thread.
  void submit(const StickDemand& demand, TimeNs now);
  /// Any thread. Latched.
  void kill() { killed_.store(true, std::memory_order_release); }
  bool killed() const { return killed_.load(std::memory_order_acquire); }
  /// Any thread. The flight thread was silent so long that the rotors were ramped down. Latched.
  bool gaveUp() const { return gave_up_.load(std::memory_order_acquire); }
  /// Nothing but zero will be sent any more.
  bool stopped() const { return killed() || gaveUp(); }
  /// Flight thread: how the transmitter was at the last `step`.
  const TransmitterStatus& transmitterStatus() {
    status_.take();
    return status_.front();
  }
  /// Output thread: sends what the helicopter should get now.
  void step(TimeNs now);

 private:
  struct Stamped {
    StickDemand demand;
    TimeNs time = 0;
  };
  void send(const StickDemand& demand, TimeNs now);

  Transmitter& transmitter_;
  OutputGuard guard_;  ///< output thread
  LatestValue<Stamped> newest_;
  LatestValue<TransmitterStatus> status_;
  std::atomic<bool> killed_{false};
  std::atomic<bool> gave_up_{false};
};

}  // namespace helical
