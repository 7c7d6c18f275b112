#pragma once

#include <cstdint>

namespace helical {

enum class ImageQuality : std::uint8_t {
  kOff,
  kJpeg,
  kLossless,  ///< as the camera gave them, also Bayer patterns
};

/// Which of one camera's images a session keeps.
struct ImageRecording {
  ImageQuality quality = ImageQuality::kOff;
  double rate_hz = 0.0;  ///< at most so many; 0: every frame
  bool at_once = true;   ///< else from when `Recorder::recordImages` says
};

}  // namespace helical
