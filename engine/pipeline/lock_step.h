#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "engine/base/clock.h"
#include "engine/pipeline/announcer.h"
#include "engine/pipeline/flight_loop.h"
#include "engine/pipeline/flight_tap.h"
#include "engine/pipeline/output_loop.h"
#include "engine/pipeline/rig_hardware.h"

namespace helical {

/// A control tick of a flight that was, and what was true then as far as it is known.
struct RecordedTick {
  TimeNs time = 0;
  OperatorCommands commands;
  DeviceStatus devices;
  std::optional<HelicopterState> truth;
  std::array<std::optional<RigidTransform>, kMaxCameras> true_camera_from_world;
};

/// A flight on simulated time, on the calling thread, as fast as the machine allows: the clock moves by 1 ms,
/// cameras are polled, the flight loop ticks, the output loop sends. Bit for bit repeatable for a seed.
class LockStep {
 public:
  /// Builds the rig's hardware on a clock of its own. Throws Error. `tap` sees the flight, and outlives it.
  LockStep(const RigConfig& rig, const FlightPlan& plan, FlightTap* tap = nullptr);

  /// Advances to the next control tick and returns the state after it.
  const EngineSnapshot& tick(const OperatorCommands& commands);

  /// A tick of a recorded flight, for forks of it. Time passes until then, and nobody looks at what the cameras
  /// see meanwhile: `loop` has got what reached it in that flight. The world moves under the sticks that the
  /// loop gives and is set right by what was true.
  const EngineSnapshot& follow(const RecordedTick& recorded);
  FlightLoop& loop() { return loop_; }

  void hideCamera(CameraId camera, bool hidden);
  /// Begins a camera's calibration anew.
  void calibrate(CameraId camera, const std::string& method, std::uint64_t seed);
  /// Null, or why it cannot be done.
  const char* orderCalibration(const CalibrationOrder& order);
  /// Before the next tick. Throws Error(kInput) and changes nothing if `validate` refuses.
  void change(const FlightChange& change);

 private:
  /// Polls the cameras every millisecond on the way.
  void passTo(TimeNs time, bool looking);
  const EngineSnapshot& command(TimeNs now, const OperatorCommands& commands, const DeviceStatus& devices);
  void setRight(const RecordedTick& recorded);
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
  TimeNs counted_from_ = 0;  ///< the recorded flight's last tick, if there was one
  std::uint64_t ticks_ = 0;  ///< since then
};

}  // namespace helical
