#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/ids.h"

namespace helical {

/// What may go wrong in a flight.
enum class FaultKind : std::uint8_t {
  kCamerasHidden,         ///< all of them: no pose
  kCameraHidden,          ///< one sees nothing
  kCameraLost,            ///< its frames do not come any more
  kCameraKnocked,         ///< it stands otherwise than before
  kCameraLate,            ///< its frames come late
  kCamerasSwapped,        ///< two cables are at each other's place
  kMarkersMissing,        ///< balls are not found
  kMarkersFalse,          ///< things that look like balls are
  kMarkersSwapped,        ///< a ball is seen near another one's place
  kClockJump,             ///< a camera's stamps are off from now on
  kTransmitterUnplugged,  ///< its outputs go to 0
  kTransmitterStalled,    ///< it keeps what it was told before
  kTransmitterSlow,       ///< demands take longer
  kGust,
  kProcessorStarved,      ///< control ticks come late
  kDiskFull,              ///< the record stops
  kParameters,            ///< the helicopter is another than was thought, by up to 30 % in everything
};
inline constexpr int kFaultKindCount = 17;

const char* toString(FaultKind kind);

/// Within how long the flight must have noticed, in seconds, as engine/flight/README.md has it; NaN for what is to be
/// borne, not noticed.
double detectionLimit(FaultKind kind);

/// One thing that goes wrong from one time to another.
struct Fault {
  FaultKind kind = FaultKind::kGust;
  double from_s = 0.0, to_s = 0.0;
  CameraId camera;        ///< of those about one
  CameraId other;         ///< of kCamerasSwapped
  double amount = 0.0;    ///< s, rad, m/s or a share, after its kind
  double direction = 0.0; ///< of a gust [rad]
};

/// One to four faults of random kinds at random times, some before the start; the same for a seed. No kind twice.
std::vector<Fault> drawFaults(std::uint64_t seed, int cameras);

}  // namespace helical
