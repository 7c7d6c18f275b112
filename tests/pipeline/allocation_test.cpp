// Nothing on the per-frame path allocates: observations in, sticks out.

#include <gtest/gtest.h>

#include "engine/config/plan_file.h"
#include "engine/config/resource_files.h"
#include "engine/geometry/rotation.h"
#include "engine/pipeline/first_guess.h"
#include "engine/pipeline/flight_loop.h"
#include "engine/pipeline/output_loop.h"
#include "engine/pipeline/rig_hardware.h"
#include "tests/pipeline/flight_fixture.h"
#include "tests/support/allocation_counter.h"

namespace helical {
namespace {

class SilentTransmitter final : public Transmitter {
 public:
  void send(const StickDemand&, TimeNs) override {}
};

TEST(FlightLoopAllocation, NoneFromTheFirstFrameToTheLanding) {
  RigConfig rig = test::shippedRig("paper", 9);
  test::cover(rig, {0, 1, 2}, 8.0, 8.4);  // a gap and its acquisition, too
  giveFirstGuesses(rig, toRadians(15.0), 0.4, 9, true);
  rig.simulation.bumps = {{cameraId(0), 11.0, toRadians(2.0), 0.02},
                          {cameraId(2), 14.0, toRadians(2.0), 0.02}};
  rig.self_calibration = {1e-3, 0.01};
  rig.simulation.marker_error_m = 1e-3;
  auto clock = std::make_shared<ManualClock>();
  RigHardware hardware = openRig(rig, clock);
  FlightLoop loop(rig, loadPlan(planPath("hover")));
  OutputLoop to_helicopter(*hardware.transmitter);
  SilentTransmitter silent;
  OutputLoop output(silent);

  long allocated = 0;
  const auto counted = [&allocated](auto&& step) {
    const long before = test::allocations();
    step();
    allocated += test::allocations() - before;
  };
  Observation observation;
  for (int ms = 1; ms < 26'000; ++ms) {
    const TimeNs now = ms * kNanosecondsPerMillisecond;
    clock->set(now);
    for (auto& source : hardware.sources)
      while (source->poll(observation)) counted([&] { loop.onObservation(observation, now); });
    if (ms == 20'000)
      counted([&] { EXPECT_EQ(loop.orderCalibration({CalibrationOrderKind::kRefine, {}, {}, {}}), nullptr); });
    if (ms % 17 != 0) continue;
    OperatorCommands commands;
    commands.arm = commands.take_off = ms == 17 * 60;
    StickDemand sticks;
    counted([&] {
      sticks = loop.onTick(now, commands);
      output.submit(sticks, now);
      output.step(now);
    });
    to_helicopter.submit(sticks, now);  // the simulated one keeps its delayed demands in a list
    to_helicopter.step(now);
  }
  EXPECT_EQ(allocated, 0);
  EXPECT_EQ(loop.snapshot().refinement.outcome, RefinementOutcome::kCorrected);
  EXPECT_TRUE(hardware.world->verdict().has_flown);
  EXPECT_EQ(loop.snapshot().cameras[0].knocks_found, 1);
  EXPECT_EQ(loop.snapshot().cameras[2].knocks_found, 1);
  EXPECT_NE(loop.snapshot().failsafes & static_cast<std::uint32_t>(Failsafe::kNoPoseCoast), 0u);
}

}  // namespace
}  // namespace helical
