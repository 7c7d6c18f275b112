#include "engine/simulator/simulated_transmitter.h"

#include <algorithm>
#include <cmath>

#include "engine/simulator/random_streams.h"

namespace helical {
namespace {

constexpr double kConverterSteps = 4095.0;

double quantised(double value, double low, double high) {
  const double step = (high - low) / kConverterSteps;
  return low + std::round((std::clamp(value, low, high) - low) / step) * step;
}

}  // namespace

SimulatedTransmitter::SimulatedTransmitter(const SimulationOptions& options, std::shared_ptr<World> world)
    : world_(std::move(world)),
      delay_(fromSeconds(randomStream(options.seed, RandomStream::kTransmitter).uniform(0.010, 0.020))) {}

void SimulatedTransmitter::send(const StickDemand& demand, TimeNs now) {
  const StickDemand sent{quantised(demand.upper_rotor, 0.0, 1.0), quantised(demand.lower_rotor, 0.0, 1.0),
                         quantised(demand.roll, -1.0, 1.0), quantised(demand.pitch, -1.0, 1.0)};
  world_->command(sent, now + delay_);
}

}  // namespace helical
