#pragma once

#include <cstdint>
#include <memory>

#include "engine/cameras/frame.h"
#include "engine/flight/autopilot.h"
#include "engine/flight/flight_change.h"
#include "engine/markers/observation.h"
#include "engine/pipeline/calibration_order.h"
#include "engine/pipeline/snapshot.h"

namespace helical {

/// Sees everything that goes into a flight loop, in the order in which it does, and what comes out: who
/// repeats it to another loop gets the same flight. Called on the flight thread, but for `onFrame`:
/// implementations on a flight in real time neither lock nor allocate, and never throw.
class FlightTap {
 public:
  virtual ~FlightTap() = default;

  /// `now`: of its use; `track`: what became of it.
  virtual void onObservation(const Observation& observation, TimeNs now, const CameraTrack& track) = 0;
  /// `state` after the tick, at whose time `commands` were given.
  virtual void onTick(const OperatorCommands& commands, const EngineSnapshot& state) = 0;
  /// A camera was hidden or shown again.
  virtual void onHidden(CameraId camera, bool hidden, TimeNs now) = 0;
  /// A camera's calibration began anew. `method` is a literal.
  virtual void onCalibration(CameraId camera, const char* method, std::uint64_t seed, TimeNs now) = 0;
  /// The operator decided something about a camera's calibration.
  virtual void onCalibrationOrder(const CalibrationOrder& order, TimeNs now) = 0;
  /// Plan, gains or trims are others from the next tick on. The engine keeps `change` as long as itself:
  /// letting go of it frees nothing.
  virtual void onChange(const std::shared_ptr<const FlightChange>& change, TimeNs now) = 0;
  virtual void onEvent(const EngineEvent& event) = 0;

  // What no flight depends on:
  /// What a camera's calibrator believes, thirty times a second.
  virtual void onBelief(CameraId camera, const CalibrationView& belief, TimeNs now) = 0;
  /// A camera's frame and what was found in it, on the camera's capture thread.
  virtual void onFrame(const Frame& frame, const Observation& observation) = 0;
  /// For the snapshot: how the record is doing.
  virtual RecordHealth health() const = 0;
};

}  // namespace helical
