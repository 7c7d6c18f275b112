#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>

namespace helical {

/// A frame of a recording.
struct MediaFrame {
  cv::Mat bgr;
  int index = 0;  ///< counted from 0
  std::optional<double>
      time_s;  ///< since the first frame; nothing where no clock is known (a folder of images)
};

/// Frames of an image, of a video or of a folder of images (in the order of the numbers in their names), all
/// of one size. Throws Error(kInput) that names the file and the frame if something is missing, damaged or
/// cut off.
class MediaReader {
 public:
  static std::unique_ptr<MediaReader> open(const std::filesystem::path& media);
  virtual ~MediaReader() = default;

  /// False after the last frame.
  virtual bool next(MediaFrame& frame) = 0;

  /// As far as the file tells; 0 if it does not.
  virtual int frameCount() const = 0;
};

/// One image file as BGR. Throws as MediaReader does.
cv::Mat readImage(const std::filesystem::path& file);

}  // namespace helical
