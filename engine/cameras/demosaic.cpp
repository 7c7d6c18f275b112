#include "engine/cameras/demosaic.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace helical {
namespace {

int conversion(PixelFormat format) {
  switch (format) {
    case PixelFormat::kMono8:
      return cv::COLOR_GRAY2BGR;
    case PixelFormat::kRgb8:
      return cv::COLOR_RGB2BGR;
    case PixelFormat::kBayerRg8:
      return cv::COLOR_BayerRGGB2BGR;
    case PixelFormat::kBayerGr8:
      return cv::COLOR_BayerGRBG2BGR;
    case PixelFormat::kBayerGb8:
      return cv::COLOR_BayerGBRG2BGR;
    case PixelFormat::kBayerBg8:
      return cv::COLOR_BayerBGGR2BGR;
    case PixelFormat::kBgr8:
      break;
  }
  return -1;
}

}  // namespace

void toBgr(const ImageView& image, std::vector<std::uint8_t>& bgr) {
  bgr.resize(3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  const int channels = bytesPerPixel(image.format);
  const cv::Mat from(image.height, image.width, CV_8UC(channels), const_cast<std::uint8_t*>(image.data),
                     static_cast<std::size_t>(image.stride));
  cv::Mat to(image.height, image.width, CV_8UC3, bgr.data());
  const int code = conversion(image.format);
  if (code < 0)
    from.copyTo(to);
  else
    cv::cvtColor(from, to, code);
}

}  // namespace helical
