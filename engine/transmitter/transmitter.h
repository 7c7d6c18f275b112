#pragma once

#include "engine/base/time.h"
#include "engine/helicopter/stick_demand.h"

namespace helical {

/// Carries stick positions to the helicopter. Called by the output thread only.
class Transmitter {
 public:
  virtual ~Transmitter() = default;

  /// Hands over the newest demand at time `now`. Never blocks for longer than the device needs.
  virtual void send(const StickDemand& demand, TimeNs now) = 0;
};

}  // namespace helical
