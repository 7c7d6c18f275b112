#pragma once

#include <memory>

#include "engine/simulator/simulation_options.h"
#include "engine/simulator/world.h"
#include "engine/transmitter/transmitter.h"

namespace helical {

/// The transmitter of the simulated field: a 12-bit D/A converter on each channel, then 10 to 20 ms (drawn)
/// of radio and receiver. One thread.
class SimulatedTransmitter final : public Transmitter {
 public:
  SimulatedTransmitter(const SimulationOptions& options, std::shared_ptr<World> world);
  void send(const StickDemand& demand, TimeNs now) override;

 private:
  std::shared_ptr<World> world_;
  TimeNs delay_;
};

}  // namespace helical
