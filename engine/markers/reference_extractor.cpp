#include "engine/markers/reference_extractor.h"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "engine/base/clock.h"
#include "engine/markers/colour_range.h"
#include "engine/markers/region_labeller.h"

namespace helical {
namespace {

/// OpenCV has no view of constant pixels; nothing here writes to them.
cv::Mat matOf(const ImageView& image) {
  return cv::Mat(image.height, image.width, image.format == PixelFormat::kBgr8 ? CV_8UC3 : CV_8UC1,
                 const_cast<std::uint8_t*>(image.data), static_cast<std::size_t>(image.stride));
}

cv::Mat differenceMask(const cv::Mat& image, const cv::Mat& background, int threshold) {
  cv::Mat difference, largest;
  cv::absdiff(image, background, difference);
  std::vector<cv::Mat> channels;
  cv::split(difference, channels);
  largest = channels.front();
  for (std::size_t i = 1; i < channels.size(); ++i) cv::max(largest, channels[i], largest);
  cv::Mat mask;
  cv::threshold(largest, mask, threshold, 255, cv::THRESH_BINARY);
  return mask;
}

cv::Mat colourMask(const cv::Mat& image, const MarkerOptions& options) {
  cv::Mat mask;
  if (image.channels() == 1)
    cv::inRange(image, cv::Scalar(options.value_low), cv::Scalar(options.value_high), mask);
  else
    markerColourMask(image, options, mask);
  return mask;
}

void applyMorphology(cv::Mat& mask, int operation, int side) {
  cv::morphologyEx(mask, mask, operation, cv::getStructuringElement(cv::MORPH_RECT, {side, side}));
}

std::vector<Region> regionsOf(const cv::Mat& mask) {
  cv::Mat labels, statistics, centroids;
  const int count = cv::connectedComponentsWithStats(mask, labels, statistics, centroids, 8, CV_32S);
  std::vector<Region> regions;
  for (int i = 1; i < count; ++i) {
    const std::int64_t area = statistics.at<int>(i, cv::CC_STAT_AREA);
    regions.push_back({area, std::llround(centroids.at<double>(i, 0) * static_cast<double>(area)),
                       std::llround(centroids.at<double>(i, 1) * static_cast<double>(area))});
  }
  return regions;
}

}  // namespace

ReferenceExtractor::ReferenceExtractor(const MarkerOptions& options)
    : options_(options), background_(options.background_frames) {
  validate(options);
}

void ReferenceExtractor::extract(const ImageView& view, Observation& observation) {
  const TimeNs start = threadCpuTime();
  background_.update(view);
  std::vector<Region> regions;
  if (background_.state() != BackgroundModel::State::kTaking) {
    const cv::Mat image = matOf(view);
    cv::Mat mask = colourMask(image, options_);
    if (background_.state() == BackgroundModel::State::kReady)
      cv::bitwise_and(mask, differenceMask(image, matOf(background_.view()), options_.background_threshold),
                      mask);
    applyMorphology(mask, cv::MORPH_OPEN, options_.opening_px);
    applyMorphology(mask, cv::MORPH_CLOSE, options_.closing_px);
    regions = regionsOf(mask);
  }
  fillCentroids(regions, options_, observation);
  observation.extraction = threadCpuTime() - start;
}

}  // namespace helical
