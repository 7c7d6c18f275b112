#pragma once

#include <cstdint>
#include <functional>

#include "engine/config/rig_config.h"

namespace helical {

/// What calibrating sixteen cameras costs in one frame of all of them.
struct ManyCamerasResult {
  int cameras = 0;
  int frames = 0;
  double mean_us = 0.0, slow_us = 0.0;  ///< thread CPU time; `slow_us`: 99.9th percentile
};

/// Sixteen un-calibrated cameras by `joint` over `rounds` flights of 13 s, on the calling thread.
ManyCamerasResult studySixteenCameras(int rounds, std::uint64_t first_seed,
                                      const std::function<void(int)>& progress);

/// Memory in use during one long flight [bytes].
struct MemoryResult {
  double flown_s = 0.0;
  double after_a_minute = 0.0, at_the_end = 0.0, most = 0.0;
};

/// One hovering flight of `duration_s` on the calling thread; memory is what the allocator has handed out to it
/// beyond what was in use before.
MemoryResult studyMemory(const RigConfig& rig, double duration_s, std::uint64_t seed,
                         const std::function<void(double)>& progress);

}  // namespace helical
