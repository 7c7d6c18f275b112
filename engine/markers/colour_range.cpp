#include "engine/markers/colour_range.h"

#include <opencv2/imgproc.hpp>

namespace helical {
namespace {

void inHueRange(const cv::Mat& hsv, const ColourRange& o, int hue_low, int hue_high, cv::Mat& mask) {
  cv::inRange(hsv, cv::Scalar(hue_low, o.saturation_low, o.value_low),
              cv::Scalar(hue_high, o.saturation_high, o.value_high), mask);
}

}  // namespace

void markerColourMask(const cv::Mat& bgr, const ColourRange& options, cv::Mat& mask) {
  cv::Mat hsv;
  cv::cvtColor(bgr, hsv, cv::COLOR_BGR2HSV);
  if (options.hue_low <= options.hue_high) {
    inHueRange(hsv, options, options.hue_low, options.hue_high, mask);
    return;
  }
  cv::Mat above;
  inHueRange(hsv, options, options.hue_low, 179, above);
  inHueRange(hsv, options, 0, options.hue_high, mask);
  cv::bitwise_or(above, mask, mask);
}

}  // namespace helical
