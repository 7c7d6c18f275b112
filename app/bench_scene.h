#pragma once

#include <opencv2/core.hpp>

namespace helical {

/// What a camera of the default rig sees, by the simulator's renderer: the empty field, and the helicopter in
/// it.
struct BenchScene {
  cv::Mat background;
  cv::Mat frame;
};

/// The lens grows with the image, so that the picture stays the same.
BenchScene renderBenchScene(int width, int height);

}  // namespace helical
