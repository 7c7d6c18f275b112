// The library that is loaded with the first video, film or webcam: see video_library.cpp.

#include <opencv2/core/utils/logger.hpp>
#include <opencv2/videoio.hpp>

#include "engine/cameras/video/video_capture.h"
#include "engine/cameras/video/video_film.h"

namespace helical {
namespace {

int toOpencv(VideoCapture::Property property) {
  switch (property) {
    case VideoCapture::Property::kWidth:
      return cv::CAP_PROP_FRAME_WIDTH;
    case VideoCapture::Property::kHeight:
      return cv::CAP_PROP_FRAME_HEIGHT;
    case VideoCapture::Property::kRate:
      return cv::CAP_PROP_FPS;
    case VideoCapture::Property::kFrameCount:
      return cv::CAP_PROP_FRAME_COUNT;
    case VideoCapture::Property::kFourCc:
      return cv::CAP_PROP_FOURCC;
    case VideoCapture::Property::kAutoExposure:
      return cv::CAP_PROP_AUTO_EXPOSURE;
    case VideoCapture::Property::kExposure:
      return cv::CAP_PROP_EXPOSURE;
    case VideoCapture::Property::kGain:
      return cv::CAP_PROP_GAIN;
    case VideoCapture::Property::kTimeMs:
      return cv::CAP_PROP_POS_MSEC;
  }
  return -1;
}

template <class Action>
bool guarded(Action action) {
  try {
    return action();
  } catch (const cv::Exception&) {
    return false;
  }
}

class OpencvCapture final : public VideoCapture {
 public:
  bool openFile(const std::string& path) override {
    return guarded([&] { return capture_.open(path, cv::CAP_FFMPEG); });
  }
  bool openDevice(const std::string& path) override {
    return guarded([&] { return capture_.open(path, cv::CAP_V4L2); });
  }
  bool set(Property property, double value) override {
    return guarded([&] { return capture_.set(toOpencv(property), value); });
  }
  double get(Property property) const override {
    double value = 0.0;
    guarded([&] { return value = capture_.get(toOpencv(property)), true; });
    return value;
  }
  bool read(ImageView& bgr) override {
    const bool whole = guarded([&] { return capture_.read(frame_) && !frame_.empty() && frame_.type() == CV_8UC3; });
    if (whole) bgr = {frame_.data, frame_.cols, frame_.rows, static_cast<int>(frame_.step), PixelFormat::kBgr8};
    return whole;
  }

 private:
  mutable cv::VideoCapture capture_;
  cv::Mat frame_;
};

class OpencvFilm final : public VideoFilm {
 public:
  bool open(const std::string& path, const std::string& coding, double rate_hz, int width, int height) override {
    return guarded([&] {
      const int code = cv::VideoWriter::fourcc(coding.at(0), coding.at(1), coding.at(2), coding.at(3));
      return writer_.open(path, cv::CAP_FFMPEG, code, rate_hz, {width, height});
    });
  }
  void write(const ImageView& bgr) override {
    guarded([&] {
      writer_.write(cv::Mat(bgr.height, bgr.width, CV_8UC3, const_cast<std::uint8_t*>(bgr.data),
                            static_cast<std::size_t>(bgr.stride)));
      return true;
    });
  }

 private:
  cv::VideoWriter writer_;
};

}  // namespace
}  // namespace helical

extern "C" [[gnu::visibility("default")]] helical::VideoFilm* helicalMakeVideoFilm() {
  return new helical::OpencvFilm;
}

extern "C" [[gnu::visibility("default")]] helical::VideoCapture* helicalMakeVideoCapture() {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  return new helical::OpencvCapture;
}
