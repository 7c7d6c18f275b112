#pragma once

#include <cstdint>

#include "engine/base/ids.h"
#include "engine/base/time.h"

namespace helical {

/// Bayer formats are named as GigE Vision names them: by the two first pixels of the first row.
enum class PixelFormat : std::uint8_t { kMono8, kBgr8, kRgb8, kBayerRg8, kBayerGr8, kBayerGb8, kBayerBg8 };

/// In a row, one after the other.
constexpr int bytesPerPixel(PixelFormat format) {
  return format == PixelFormat::kBgr8 || format == PixelFormat::kRgb8 ? 3 : 1;
}

/// Pixels that somebody else owns. Row y starts at `data + y * stride`.
struct ImageView {
  const std::uint8_t* data = nullptr;
  int width = 0;
  int height = 0;
  int stride = 0;  ///< bytes
  PixelFormat format = PixelFormat::kBgr8;

  const std::uint8_t* row(int y) const { return data + static_cast<std::ptrdiff_t>(y) * stride; }
};

/// One exposure. The pixels stay valid until the same source's next `poll`.
struct Frame {
  CameraId camera;
  std::uint64_t sequence = 0;  ///< counts exposures; a gap is a dropped frame
  TimeNs exposure = 0;         ///< mid-exposure
  TimeNs arrival = 0;          ///< when the last byte reached this machine
  ImageView image;
  TimeNs first_packet = 0;  ///< when the first byte reached this machine; 0 where nobody tells
  TimeNs device_time = 0;   ///< of the exposure on the camera's own clock, as it stamped it; 0 without one
};

}  // namespace helical
