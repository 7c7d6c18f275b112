#include "app/opencv_pipeline.h"

#include <opencv2/imgproc.hpp>

namespace helical {
namespace {

cv::Mat square(int side) {
  return cv::getStructuringElement(cv::MORPH_RECT, {side, side});
}

}  // namespace

OpencvPipeline::OpencvPipeline(const MarkerOptions& options, Labelling labelling)
    : options_(options),
      labelling_(labelling),
      opening_(square(options.opening_px)),
      closing_(square(options.closing_px)) {}

void OpencvPipeline::run(const cv::Mat& frame, const cv::Mat& background) {
  subtractBackground(frame, background);
  selectColour(frame);
  openAndClose();
  if (labelling_ == Labelling::kConnectedComponents)
    labelComponents();
  else
    labelContours();
}

void OpencvPipeline::subtractBackground(const cv::Mat& frame, const cv::Mat& background) {
  cv::absdiff(frame, background, difference_);
  cv::split(difference_, channels_);
  cv::max(channels_[0], channels_[1], largest_);
  cv::max(largest_, channels_[2], largest_);
  cv::threshold(largest_, foreground_, options_.background_threshold, 255, cv::THRESH_BINARY);
}

void OpencvPipeline::selectColour(const cv::Mat& frame) {
  cv::cvtColor(frame, hsv_, cv::COLOR_BGR2HSV);
  cv::inRange(hsv_, cv::Scalar(options_.hue_low, options_.saturation_low, options_.value_low),
              cv::Scalar(options_.hue_high, options_.saturation_high, options_.value_high), colour_);
}

void OpencvPipeline::openAndClose() {
  cv::bitwise_and(foreground_, colour_, candidates_);
  cv::morphologyEx(candidates_, mask_, cv::MORPH_OPEN, opening_);
  cv::morphologyEx(mask_, mask_, cv::MORPH_CLOSE, closing_);
}

void OpencvPipeline::labelComponents() {
  regions_ = cv::connectedComponentsWithStats(mask_, labels_, statistics_, centroids_, 8, CV_32S) - 1;
}

void OpencvPipeline::labelContours() {
  cv::findContours(mask_, contours_, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  moments_.clear();
  for (const auto& contour : contours_) moments_.push_back(cv::moments(contour));
  regions_ = static_cast<int>(contours_.size());
}

}  // namespace helical
