#pragma once

#include <QColor>
#include <QString>

#include "engine/pipeline/snapshot.h"

namespace helical {

/// A state as one coloured word.
struct StatusWord {
  QString text;
  QColor color;
};

StatusWord cameraStatusWord(CameraStatus status);
/// Of a camera that is calibrated in flight: also what it waits for.
StatusWord calibrationWord(const EngineSnapshot& snapshot, int camera);
StatusWord phaseWord(FlightPhase phase);
StatusWord safetyWord(SafetyState state);

/// The one word of the top bar: what the operator must know first.
StatusWord readinessWord(const EngineSnapshot& snapshot);

/// Whose sticks the helicopter obeys: Helical's, those of the pilot's own transmitter, or nobody's.
StatusWord pilotWord(const EngineSnapshot& snapshot);

/// Names of the failsafes that have acted, comma separated; empty if none has.
QString failsafeNames(std::uint32_t failsafes);

/// Rotors may be turning.
bool inFlight(FlightPhase phase);

/// There is a set-point that it follows.
bool hasReference(const EngineSnapshot& snapshot);

/// Cameras whose newest frame, at most a quarter of a second old, helped the pose.
int trackedCameras(const EngineSnapshot& snapshot);

}  // namespace helical
