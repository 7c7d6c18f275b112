#pragma once

#include "engine/base/time.h"
#include "engine/helicopter/stick_demand.h"
#include "engine/transmitter/transmitter_status.h"

namespace helical {

/// Carries stick positions to the helicopter. Called by the output thread only.
class Transmitter {
 public:
  virtual ~Transmitter() = default;

  /// Hands over the newest demand at time `now`. Never blocks for longer than the device needs.
  virtual void send(const StickDemand& demand, TimeNs now) = 0;

  /// A digital output toggled with each demand, for a hardware watchdog that cuts when it stops.
  virtual void beat(bool level) { static_cast<void>(level); }

  /// As of the last `send`; output thread.
  virtual TransmitterStatus status() const { return {}; }
};

}  // namespace helical
