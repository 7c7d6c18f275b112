#pragma once

#include <functional>
#include <memory>

#include "engine/base/clock.h"
#include "engine/pipeline/flight_loop.h"
#include "engine/pipeline/output_loop.h"
#include "engine/pipeline/rig_hardware.h"

namespace helical {

/// A flight on simulated time, on the calling thread, as fast as the machine allows: the clock moves by 1 ms,
/// cameras are polled, the flight loop ticks, the output loop sends. Bit for bit repeatable for a seed.
class LockStep {
 public:
  /// Builds the rig's hardware on a clock of its own. Throws Error.
  LockStep(const RigConfig& rig, const FlightPlan& plan);

  /// Advances to the next control tick and returns the state after it.
  const EngineSnapshot& tick(const OperatorCommands& commands);

  void hideCamera(CameraId camera, bool hidden) { loop_.hideCamera(camera, hidden); }

 private:
  std::shared_ptr<ManualClock> clock_;
  RigHardware hardware_;
  FlightLoop loop_;
  OutputLoop output_;
  EngineSnapshot snapshot_;
  double tick_period_s_;
  std::uint64_t ticks_ = 0;
};

}  // namespace helical
