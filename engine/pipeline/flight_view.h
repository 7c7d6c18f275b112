#pragma once

#include <cstdint>

#include "engine/config/rig_config.h"
#include "engine/flight/flight_plan.h"
#include "engine/pipeline/snapshot.h"

namespace helical {

/// A flight to look at, live or recorded. For one thread (the window's); nothing here waits for the flight.
class FlightView {
 public:
  virtual ~FlightView() = default;

  virtual const RigConfig& rig() const = 0;
  virtual const FlightPlan& plan() const = 0;

  /// True if `snapshot()` is newer than at the last call.
  virtual bool poll() = 0;
  virtual const EngineSnapshot& snapshot() const = 0;

  /// Newest picture of a camera at display rate; false if there is none since the last call.
  virtual bool pollPicture(CameraId camera) = 0;
  virtual const CameraPicture& picture(CameraId camera) const = 0;

  /// What a camera's calibrator believes, at display rate; false if there is nothing new since the last call.
  virtual bool pollCalibration(CameraId camera) = 0;
  virtual const CalibrationView& calibration(CameraId camera) const = 0;

  /// Every control tick's snapshot in order, for plots that must not miss one; false when there is none.
  virtual bool nextTick(EngineSnapshot& tick) = 0;
  virtual bool nextEvent(EngineEvent& event) = 0;
  /// Ticks and events lost because the window did not fetch them in time.
  virtual std::uint64_t lostTicks() const = 0;
};

}  // namespace helical
