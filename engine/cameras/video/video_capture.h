#pragma once

#include <memory>
#include <string>

#include "engine/cameras/frame.h"

namespace helical {

/// A video file or a webcam as the video library reads it: OpenCV's VideoCapture and nothing beyond, so that tests
/// can stand in for it. One thread. Never throws.
class VideoCapture {
 public:
  enum class Property {
    kWidth,
    kHeight,
    kRate,        ///< frames per second
    kFrameCount,  ///< of a file, as far as it tells
    kFourCc,      ///< how frames are coded, four characters as one number
    kAutoExposure,
    kExposure,
    kGain,
    kTimeMs,  ///< of the newest frame; a webcam's is on CLOCK_MONOTONIC
  };

  virtual ~VideoCapture() = default;

  virtual bool openFile(const std::string& path) = 0;
  virtual bool openDevice(const std::string& path) = 0;
  virtual bool set(Property property, double value) = 0;
  /// 0 for what it does not know.
  virtual double get(Property property) const = 0;
  /// The next frame as BGR, valid until the next call; waits for it, a second at most. False when there is none.
  virtual bool read(ImageView& bgr) = 0;
};

/// Four characters as one number, and back: "MJPG".
double toFourCc(const std::string& name);
std::string nameOfFourCc(double code);

/// Not opened yet. The video library is loaded with the first one. Throws Error(kSystem) when it is missing.
std::unique_ptr<VideoCapture> makeVideoCapture();

}  // namespace helical
