#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "engine/cameras/frame.h"

namespace helical {

/// A frame of a recording.
struct MediaFrame {
  ImageView bgr;                 ///< valid until the reader's next `next`, or as long as `pixels` if that is set
  int index = 0;                 ///< counted from 0
  std::optional<double> time_s;  ///< since the first frame; nothing where no clock is known (a folder of images)
  std::shared_ptr<const void> pixels;
};

/// Frames of an image, of a video or of a folder of images (in the order of the numbers in their names), all
/// of one size. Throws Error(kInput) that names the file and the frame if something is missing, damaged or
/// cut off. One thread.
class MediaReader {
 public:
  static std::unique_ptr<MediaReader> open(const std::filesystem::path& media);
  virtual ~MediaReader() = default;

  /// False after the last frame.
  virtual bool next(MediaFrame& frame) = 0;

  /// As far as the file tells; 0 if it does not.
  virtual int frameCount() const = 0;
  /// Frames per second; 0 where no clock is known.
  virtual double rate() const = 0;
};

/// One image file as BGR, with its pixels. Throws as MediaReader does.
MediaFrame readImage(const std::filesystem::path& file);

}  // namespace helical
