#pragma once

#include <vector>

namespace helical {

/// A box of colours in OpenCV's HSV. Of an image without colour only the value counts: its brightness.
struct ColourRange {
  int hue_low = 40;         ///< 0..179
  int hue_high = 80;        ///< smaller than `hue_low` wraps through red
  int saturation_low = 70;  ///< 0..255
  int saturation_high = 255;
  int value_low = 40;  ///< 0..255
  int value_high = 255;

  bool operator==(const ColourRange&) const = default;
};

/// How a marker's centre is found in its region.
enum class CentroidEstimator {
  kBinary,  ///< the centre of gravity of the region
  kDisc     ///< the picture of a shaded ball fitted to the pixels (DiscFit); the region's where that is none
};

/// How markers are told from everything else (the paper's section IV.B): the first colour is the base's.
struct MarkerOptions : ColourRange {
  std::vector<ColourRange> other_colours;  ///< looked for each by itself; `Centroid::colour` says which
  int background_threshold = 20;  ///< largest channel difference from the background that still is background
  int background_frames = 8;      ///< averaged into the background at start
  int background_rows = 2;  ///< of the background that follow the light after each frame, in turn; 0: none
  int whole_every = 15;     ///< frames, of which one is read as a whole; 1: each
  /// Sides of the square structuring elements, odd; 1 switches the step off. On Bayer frames, whose cells are
  /// 2 px wide, the nearest odd number of those: none for 3 px, for a ball of 4 px in radius rarely holds 3 x
  /// 3 of them.
  int opening_px = 3;
  int closing_px = 3;
  int minimum_area_px = 9;
  int maximum_area_px = 20000;
  CentroidEstimator estimator = CentroidEstimator::kDisc;
  /// Standard deviation of a fully visible ball's centroid per axis; measured, see tests/pipeline.
  double centroid_sigma_px = 0.10;
};

/// Throw Error(kInput) with the offending key when a value is out of its range.
void validate(const ColourRange& colour);
void validate(const MarkerOptions& options);

}  // namespace helical
