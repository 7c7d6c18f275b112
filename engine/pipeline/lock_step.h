#pragma once

#include <functional>
#include <memory>
#include <string>

#include "engine/base/clock.h"
#include "engine/pipeline/announcer.h"
#include "engine/pipeline/flight_loop.h"
#include "engine/pipeline/flight_tap.h"
#include "engine/pipeline/output_loop.h"
#include "engine/pipeline/rig_hardware.h"

namespace helical {

/// A flight on simulated time, on the calling thread, as fast as the machine allows: the clock moves by 1 ms,
/// cameras are polled, the flight loop ticks, the output loop sends. Bit for bit repeatable for a seed.
class LockStep {
 public:
  /// Builds the rig's hardware on a clock of its own. Throws Error. `tap` sees the flight, and outlives it.
  LockStep(const RigConfig& rig, const FlightPlan& plan, FlightTap* tap = nullptr);

  /// Advances to the next control tick and returns the state after it.
  const EngineSnapshot& tick(const OperatorCommands& commands);

  void hideCamera(CameraId camera, bool hidden);
  /// Begins a camera's calibration anew.
  void calibrate(CameraId camera, const std::string& method, std::uint64_t seed);
  /// Null, or why it cannot be done.
  const char* orderCalibration(const CalibrationOrder& order);
  /// Before the next tick. Throws Error(kInput) and changes nothing if `validate` refuses.
  void change(const FlightChange& change);

 private:
  void use(const Observation& observation);
  void show(const OperatorCommands& commands, TimeNs now);

  RigConfig rig_;
  std::shared_ptr<ManualClock> clock_;
  RigHardware hardware_;
  FlightLoop loop_;
  OutputLoop output_;
  FlightTap* tap_;
  Announcer announcer_;
  EngineSnapshot snapshot_;
  CalibrationView belief_;
  double tick_period_s_;
  std::uint64_t ticks_ = 0;
};

}  // namespace helical
