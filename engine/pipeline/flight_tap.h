#pragma once

#include <cstdint>

#include "engine/flight/autopilot.h"
#include "engine/markers/observation.h"
#include "engine/pipeline/snapshot.h"

namespace helical {

/// Sees everything that goes into a flight loop, in the order in which it does, and what comes out: who
/// repeats it to another loop gets the same flight. Called on the flight thread: implementations on a flight
/// in real time neither lock nor allocate, and never throw.
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
  virtual void onEvent(const EngineEvent& event) = 0;
};

}  // namespace helical
