#pragma once

#include "engine/base/ids.h"
#include "engine/base/random.h"

namespace helical {

/// The parts of a simulation that draw at random, each from a generator of its own.
enum class RandomStream : std::uint64_t {
  kParameters,
  kPlacement,
  kGusts,
  kTransmitter,
  kCarrying,
  kMarkers,
  kKnocks = 100,  ///< and below: one for each camera
  kExposures = 200,
  kObservations = 300,
  kImages = 400,
  kFirstGuesses = 500,
  kFocalLengths = 600,
};

inline Random randomStream(std::uint64_t seed, RandomStream stream, CameraId camera = {}) {
  return Random(seed).fork(static_cast<std::uint64_t>(stream) + camera.value);
}

}  // namespace helical
