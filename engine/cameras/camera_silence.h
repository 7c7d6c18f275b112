#pragma once

#include <algorithm>

#include "engine/base/time.h"
#include "engine/cameras/device_options.h"

namespace helical {

/// How long a camera that sends by itself may be silent before it counts as lost: what its options say, and
/// five frames at least.
inline TimeNs longestSilence(const DeviceOptions& options) {
  constexpr double kFrames = 5.0;
  return std::max(fromSeconds(1e-3 * options.silence_ms), fromSeconds(kFrames / options.rate_hz));
}

}  // namespace helical
