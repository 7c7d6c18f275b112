#pragma once

#include <memory>
#include <string>

#include "engine/cameras/frame.h"

namespace helical {

/// A video file that is written, by OpenCV's VideoWriter and FFmpeg. One thread. Never throws.
class VideoFilm {
 public:
  virtual ~VideoFilm() = default;  ///< finishes the file

  /// `coding`: four characters, "avc1". False where this machine cannot.
  virtual bool open(const std::string& path, const std::string& coding, double rate_hz, int width, int height) = 0;
  virtual void write(const ImageView& bgr) = 0;
};

/// Not opened yet. The video library is loaded with the first one. Throws Error(kSystem) when it is missing.
std::unique_ptr<VideoFilm> makeVideoFilm();

}  // namespace helical
