#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "engine/markers/marker_options.h"

namespace helical {

/// The paper's section IV.B as one writes it with OpenCV, with its buffers kept from frame to frame: what the
/// extractor is timed against. One thread.
class OpencvPipeline {
 public:
  enum class Labelling { kConnectedComponents, kContours };

  OpencvPipeline(const MarkerOptions& options, Labelling labelling);

  /// Leaves the regions' areas and centroids in buffers of its own.
  void run(const cv::Mat& frame, const cv::Mat& background);
  int regions() const { return regions_; }

 private:
  void subtractBackground(const cv::Mat& frame, const cv::Mat& background);
  void selectColour(const cv::Mat& frame);
  void openAndClose();
  void labelComponents();
  void labelContours();

  MarkerOptions options_;
  Labelling labelling_;
  cv::Mat opening_, closing_;
  cv::Mat difference_, largest_, foreground_, hsv_, colour_, candidates_, mask_;
  std::vector<cv::Mat> channels_;
  cv::Mat labels_, statistics_, centroids_;
  std::vector<std::vector<cv::Point>> contours_;
  std::vector<cv::Moments> moments_;
  int regions_ = 0;
};

}  // namespace helical
