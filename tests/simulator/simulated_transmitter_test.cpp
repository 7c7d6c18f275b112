#include "engine/simulator/simulated_transmitter.h"

#include <gtest/gtest.h>

#include <set>

namespace helical {
namespace {

/// When a first command sent at 0.5 s makes the rotors turn [s].
double actedAt(std::uint64_t seed) {
  SimulationOptions options;
  options.seed = seed;
  const auto world = std::make_shared<World>(options, HelicopterParameters::xrb());
  SimulatedTransmitter transmitter(options, world);
  transmitter.send({0.5, 0.5, 0.0, 0.0}, fromSeconds(0.5));
  world->advanceTo(fromSeconds(0.6));
  const double still = world->at(fromSeconds(0.5))->upper_rotor_angle;
  for (int ms = 500; ms < 600; ++ms)
    if (world->at(ms * kNanosecondsPerMillisecond)->upper_rotor_angle != still) return ms * 1e-3;
  return 1.0;
}

TEST(SimulatedTransmitter, SticksActTenToTwentyMillisecondsLater) {
  std::set<double> delays;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const double delay = actedAt(seed) - 0.5;
    EXPECT_GE(delay, 0.010);
    EXPECT_LE(delay, 0.0221) << "one step to begin and one to turn";
    delays.insert(delay);
  }
  EXPECT_GE(delays.size(), 6u) << "drawn for every flight";
}

/// Whether two demands move the helicopter alike, to the last bit.
bool actAlike(const StickDemand& a, const StickDemand& b) {
  Eigen::Vector4d result[2];
  for (int i = 0; i < 2; ++i) {
    const SimulationOptions options;
    const auto world = std::make_shared<World>(options, HelicopterParameters::xrb());
    SimulatedTransmitter transmitter(options, world);
    transmitter.send(i == 0 ? a : b, fromSeconds(0.3));
    world->advanceTo(fromSeconds(1.0));
    const auto sample = *world->at(fromSeconds(1.0));
    result[i] << sample.upper_rotor_angle, sample.lower_rotor_angle,
        sample.state.world_from_body.rotation.x(), sample.state.world_from_body.rotation.y();
  }
  return result[0] == result[1];
}

TEST(SimulatedTransmitter, HasTwelveBitsOnEveryChannel) {
  const double rotor_step = 1.0 / 4095.0, swash_step = 2.0 / 4095.0;
  const StickDemand demand{1000 * rotor_step, 1100 * rotor_step, -1.0 + 2200 * swash_step,
                           -1.0 + 2500 * swash_step};
  for (double StickDemand::*channel :
       {&StickDemand::upper_rotor, &StickDemand::lower_rotor, &StickDemand::roll, &StickDemand::pitch}) {
    const bool rotor = channel == &StickDemand::upper_rotor || channel == &StickDemand::lower_rotor;
    const double step = rotor ? rotor_step : swash_step;
    for (const double within : {-0.45, 0.45}) {
      StickDemand near = demand;
      near.*channel += within * step;
      EXPECT_TRUE(actAlike(demand, near));
    }
    for (const double beyond : {-0.55, 0.55}) {
      StickDemand far = demand;
      far.*channel += beyond * step;
      EXPECT_FALSE(actAlike(demand, far));
    }
  }
}

TEST(SimulatedTransmitter, SticksEndAtTheirStops) {
  EXPECT_TRUE(actAlike({0.6, 0.6, 7.0, -7.0}, {0.6, 0.6, 1.0, -1.0}));
  EXPECT_TRUE(actAlike({1.5, -0.5, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace helical
