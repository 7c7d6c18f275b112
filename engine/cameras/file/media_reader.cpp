#include "engine/cameras/file/media_reader.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/cameras/video/video_capture.h"

namespace helical {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDamagedCure =
    "copy or record it again; if it plays elsewhere, convert it to MP4 (H.264) or PNG";

std::string frameName(int index) {
  return "frame " + std::to_string(index);
}

void checkReadable(const fs::path& file) {
  std::error_code code;
  if (!fs::exists(file, code))
    throw Error(ErrorKind::kInput, "there is no such file", file.string(), "check the path");
  if (fs::is_directory(file)) return;
  if (!std::ifstream(file))
    throw Error(ErrorKind::kInput, std::string("cannot be read: ") + std::strerror(errno), file.string(),
                "check its permissions");
  if (fs::file_size(file, code) == 0)
    throw Error(ErrorKind::kInput, "the file is empty", file.string(), kDamagedCure);
}

/// OpenCV fills the missing part of a cut-off JPEG with grey. A whole one has an end marker after its last
/// scan.
bool isCutOffJpeg(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (bytes.compare(0, 2, "\xff\xd8") != 0) return false;
  const auto scan = bytes.rfind("\xff\xda"), end = bytes.rfind("\xff\xd9");
  return scan == std::string::npos || end == std::string::npos || end < scan;
}

/// The video library takes plain text for an animation of letters.
bool isText(const fs::path& file) {
  std::string start(512, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(stream.gcount()));
  return std::all_of(start.begin(), start.end(),
                     [](unsigned char c) { return c >= 0x20 || std::isspace(c) != 0; });
}

Error notMedia(const fs::path& file) {
  return {ErrorKind::kInput, "this is no image and no video", file.string(),
          "give a PNG, a JPEG, an MP4 or a folder of images"};
}

/// With its pixels.
MediaFrame decodeImage(const fs::path& file, const std::string& where) {
  if (isCutOffJpeg(file)) throw Error(ErrorKind::kInput, "the image is cut off", where, kDamagedCure);
  const auto image = std::make_shared<cv::Mat>();
  try {
    *image = cv::imread(file.string(), cv::IMREAD_COLOR);
  } catch (const cv::Exception&) {
    image->release();
  }
  if (image->empty()) throw Error(ErrorKind::kInput, "the image is damaged or cut off", where, kDamagedCure);
  MediaFrame frame;
  frame.bgr = {image->data, image->cols, image->rows, static_cast<int>(image->step), PixelFormat::kBgr8};
  frame.pixels = image;
  return frame;
}

std::string sizeName(const ImageView& image) {
  return std::to_string(image.width) + "x" + std::to_string(image.height);
}

/// One image, or the images of a folder.
class ImageFiles final : public MediaReader {
 public:
  explicit ImageFiles(std::vector<fs::path> files) : files_(std::move(files)) {}

  bool next(MediaFrame& frame) override {
    if (next_ == files_.size()) return false;
    const fs::path& file = files_[next_];
    const std::string where = file.string() + ", " + frameName(static_cast<int>(next_));
    frame = decodeImage(file, where);
    if (next_ == 0) first_ = frame.bgr;
    if (frame.bgr.width != first_.width || frame.bgr.height != first_.height)
      throw Error(ErrorKind::kInput,
                  "the image has " + sizeName(frame.bgr) + " pixels, those before it " + sizeName(first_), where,
                  "keep images of one size in a folder");
    frame.index = static_cast<int>(next_++);
    if (files_.size() == 1) frame.time_s = 0.0;
    return true;
  }
  int frameCount() const override { return static_cast<int>(files_.size()); }
  double rate() const override { return 0.0; }

 private:
  std::vector<fs::path> files_;
  std::size_t next_ = 0;
  ImageView first_;  ///< for its size
};

class VideoFile final : public MediaReader {
 public:
  explicit VideoFile(const fs::path& file) : file_(file), capture_(makeVideoCapture()) {
    if (!capture_->openFile(file.string()))
      throw Error(ErrorKind::kInput,
                  "this is no image or video that can be read, or it is damaged or cut off",
                  file.string() + ", " + frameName(0), kDamagedCure);
    count_ = std::max(0, static_cast<int>(capture_->get(VideoCapture::Property::kFrameCount)));
    rate_ = capture_->get(VideoCapture::Property::kRate);
  }

  bool next(MediaFrame& frame) override {
    frame.pixels.reset();
    if (!capture_->read(frame.bgr)) {
      checkWhole();
      return false;
    }
    frame.index = next_++;
    frame.time_s = rate_ > 0.0 ? std::optional(frame.index / rate_) : std::nullopt;
    return true;
  }
  int frameCount() const override { return count_; }
  double rate() const override { return rate_; }

 private:
  /// MP4 and AVI keep an index of their frames; elsewhere the number is estimated from the length.
  void checkWhole() const {
    const std::string extension = file_.extension().string();
    const bool has_index =
        extension == ".mp4" || extension == ".mov" || extension == ".m4v" || extension == ".avi";
    const int tolerance = has_index ? 1 : 2 + count_ / 50;
    if (next_ > 0 && next_ >= count_ - tolerance) return;
    throw Error(ErrorKind::kInput,
                "the video is damaged or cut off: it announces " + std::to_string(count_) +
                    " frames and ends before " + frameName(next_),
                file_.string() + ", " + frameName(next_), kDamagedCure);
  }

  fs::path file_;
  std::unique_ptr<VideoCapture> capture_;
  int count_ = 0;
  int next_ = 0;
  double rate_ = 0.0;
};

/// Whether it is an image, or says so by its name: one that cannot be read must not go missing unnoticed.
bool isOrShouldBeImage(const fs::path& file) {
  constexpr std::array kNames{".png", ".jpg", ".jpeg", ".bmp", ".ppm", ".pgm", ".tif", ".tiff", ".webp"};
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(kNames.begin(), kNames.end(), extension) != kNames.end() || cv::haveImageReader(file.string());
}

std::vector<fs::path> imagesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(folder, code))
    if (entry.is_regular_file() && isOrShouldBeImage(entry.path())) files.push_back(entry.path());
  if (code)
    throw Error(ErrorKind::kInput, "the folder cannot be read: " + code.message(), folder.string(),
                "check its permissions");
  if (files.empty())
    throw Error(ErrorKind::kInput, "the folder holds no image", folder.string(),
                "give a folder of PNG or JPEG files");
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return strverscmp(a.filename().c_str(), b.filename().c_str()) < 0;
  });
  return files;
}

/// The libraries behind OpenCV print on their own what our errors say better.
void silenceDecoders() {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
}

}  // namespace

std::unique_ptr<MediaReader> MediaReader::open(const fs::path& media) {
  silenceDecoders();
  checkReadable(media);
  if (fs::is_directory(media)) return std::make_unique<ImageFiles>(imagesIn(media));
  if (cv::haveImageReader(media.string())) return std::make_unique<ImageFiles>(std::vector{media});
  if (isText(media)) throw notMedia(media);
  return std::make_unique<VideoFile>(media);
}

MediaFrame readImage(const fs::path& file) {
  silenceDecoders();
  checkReadable(file);
  if (!cv::haveImageReader(file.string()))
    throw Error(ErrorKind::kInput, "this is no image", file.string(), "give a PNG or a JPEG");
  return decodeImage(file, file.string());
}

}  // namespace helical
