#include "engine/markers/reference_extractor.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "engine/markers/colour_range.h"
#include "engine/markers/region_selection.h"

namespace helical {
namespace {

/// The cells as an image in OpenCV's order: brightness, or blue, green, red.
cv::Mat cellsOf(const ImageView& image) {
  const CellGrid grid(image);
  const bool in_colour = grid.layout != CellLayout::kBytes;
  cv::Mat cells(grid.height, grid.width, in_colour ? CV_8UC3 : CV_8UC1);
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x) readCell(grid, x, y, cells.ptr(y, x));
  if (grid.red_first) cv::cvtColor(cells, cells, cv::COLOR_RGB2BGR);
  return cells;
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

cv::Mat colourMask(const cv::Mat& image, const ColourRange& colour) {
  cv::Mat mask;
  if (image.channels() == 1)
    cv::inRange(image, cv::Scalar(colour.value_low), cv::Scalar(colour.value_high), mask);
  else
    markerColourMask(image, colour, mask);
  return mask;
}

void applyMorphology(cv::Mat& mask, int operation, int side) {
  cv::morphologyEx(mask, mask, operation, cv::getStructuringElement(cv::MORPH_RECT, {side, side}));
}

void removeIgnored(const BinaryMask& ignored, cv::Mat& mask) {
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x)
      if (ignored.at(x, y)) mask.at<std::uint8_t>(y, x) = 0;
}

void copyMask(const cv::Mat& mask, BinaryMask& bits) {
  bits.resize(mask.cols, mask.rows);
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x)
      if (mask.at<std::uint8_t>(y, x) != 0) bits.row(y)[x / 64] |= std::uint64_t{1} << (x % 64);
}

std::vector<Region> regionsOf(const cv::Mat& mask) {
  cv::Mat labels, statistics, centroids;
  const int count = cv::connectedComponentsWithStats(mask, labels, statistics, centroids, 8, CV_32S);
  std::vector<Region> regions;
  for (int i = 1; i < count; ++i) {
    const int* s = statistics.ptr<int>(i);
    const auto area = static_cast<double>(s[cv::CC_STAT_AREA]);
    const int left = s[cv::CC_STAT_LEFT], top = s[cv::CC_STAT_TOP];
    regions.push_back({s[cv::CC_STAT_AREA], std::llround(centroids.at<double>(i, 0) * area),
                       std::llround(centroids.at<double>(i, 1) * area), left, top,
                       left + s[cv::CC_STAT_WIDTH] - 1, top + s[cv::CC_STAT_HEIGHT] - 1});
  }
  return regions;
}

}  // namespace

std::vector<Region> referenceRegions(const ImageView& image, const ImageView* background,
                                     const ColourRange& colour, const MarkerOptions& options,
                                     const BinaryMask* ignored, BinaryMask* bits) {
  const CellGrid grid(image);
  const cv::Mat cells = cellsOf(image);
  cv::Mat mask = colourMask(cells, colour);
  if (background != nullptr)
    cv::bitwise_and(mask, differenceMask(cells, cellsOf(*background), options.background_threshold), mask);
  if (ignored != nullptr) removeIgnored(*ignored, mask);
  applyMorphology(mask, cv::MORPH_OPEN, sideInCells(options.opening_px, grid));
  applyMorphology(mask, cv::MORPH_CLOSE, sideInCells(options.closing_px, grid));
  if (bits != nullptr) copyMask(mask, *bits);
  return regionsOf(mask);
}

ReferenceExtractor::ReferenceExtractor(const MarkerOptions& options)
    : options_(options), background_(options.background_frames) {
  validate(options);
}

void ReferenceExtractor::extract(const ImageView& image, Observation& observation) {
  background_.update(image);
  observation.count = 0;
  observation.truncated = false;
  if (background_.state() != BackgroundModel::State::kTaking) {
    const ImageView view = background_.view();
    const ImageView* background = hasBackground() ? &view : nullptr;
    const CellGrid grid(image);
    RegionSelection selection(options_);
    selection.add(referenceRegions(image, background, options_, options_), 0, grid);
    for (std::size_t i = 0; i < options_.other_colours.size(); ++i)
      selection.add(referenceRegions(image, background, options_.other_colours[i], options_),
                    static_cast<int>(i) + 1, grid);
    for (const ColouredRegion& region : selection.sorted())
      observation.centroids[static_cast<std::size_t>(observation.count++)] =
          binaryCentroid(region, grid, options_.centroid_sigma_px);
    observation.truncated = selection.truncated();
  }
}

}  // namespace helical
