#pragma once

#include "engine/markers/marker_options.h"

namespace cv {
class Mat;
}

namespace helical {

/// 255 where a BGR image has a marker's colour. The definition of the colour class: everything else is
/// derived from it. For the .cpp files of this folder only.
void markerColourMask(const cv::Mat& bgr, const ColourRange& options, cv::Mat& mask);

}  // namespace helical
