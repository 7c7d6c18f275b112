#pragma once

#include <cstdint>
#include <memory>
#include <variant>

#include "engine/flight/autopilot.h"
#include "engine/flight/flight_change.h"
#include "engine/markers/observation.h"
#include "engine/pipeline/calibration_order.h"
#include "engine/pipeline/snapshot.h"

namespace helical {

struct UsedObservation {
  Observation observation;
  TimeNs used = 0;    ///< when the flight thread took it
  CameraTrack track;  ///< what became of it
};

struct FlightTick {
  OperatorCommands commands;
  EngineSnapshot state;  ///< after the tick
};

struct CameraHidden {
  CameraId camera;
  bool hidden = false;
  TimeNs time = 0;
};

struct CalibrationBegun {
  CameraId camera;
  const char* method = "";  ///< a literal
  std::uint64_t seed = 0;
  TimeNs time = 0;
};

struct CameraBelief {
  CameraId camera;
  TimeNs time = 0;
  CalibrationView view;
};

struct CalibrationDecided {
  CalibrationOrder what;
  TimeNs time = 0;
};

struct FlightChanged {
  std::shared_ptr<const FlightChange> change;
  TimeNs time = 0;
};

/// One thing that a session writes down, in the order in which it reached the flight thread. Allocates
/// nothing.
struct FlightItem {
  std::uint64_t order =
      0;  ///< counted from 1, also what was lost on the way to the disk; events and beliefs do not count
  std::variant<EngineEvent, UsedObservation, FlightTick, CameraHidden, CalibrationBegun, CalibrationDecided,
               FlightChanged, CameraBelief>
      what;
};

}  // namespace helical
