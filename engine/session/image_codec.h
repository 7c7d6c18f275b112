#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/session/frame_queue.h"

namespace helical {

/// ROS's name of a pixel format, "bayer_rggb8".
const char* encodingName(PixelFormat format);

/// The frame as JPEG, in colour. One thread.
std::string jpegOf(const RecordedFrame& frame);

/// An image for display: packed rows, blue first.
struct BgrImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;
};

/// Of the payload of a sensor_msgs/Image or CompressedImage. Throws CutShort for what is none.
BgrImage decodeImage(std::string_view payload);
BgrImage decodeCompressedImage(std::string_view payload);

}  // namespace helical
