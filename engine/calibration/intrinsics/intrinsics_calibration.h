#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "engine/calibration/intrinsics/board.h"
#include "engine/geometry/camera_model.h"

namespace helical {

enum class IntrinsicsVerdict { kGood, kUsable, kBad };
const char* nameOf(IntrinsicsVerdict verdict);

struct IntrinsicsView {
  std::string name;
  int corners = 0;
  double rms_px = 0.0;  ///< length of the residual
  bool used = false;    ///< else an outlier, left out
};

/// Parts of the image, 3x3, and how many corners lay in each; row by row from the top left.
using Coverage = std::array<int, 9>;

struct IntrinsicsCalibration {
  IntrinsicsVerdict verdict = IntrinsicsVerdict::kBad;
  std::vector<std::string> reasons;  ///< why the verdict is not better
  CameraModel model;
  /// Standard deviations of fx fy cx cy k1 k2 p1 p2 k3 k4 k5 k6.
  std::array<double, 12> sigma{};
  double rms_px = 0.0;    ///< length of the residual, over the views in use
  double tilt_deg = 0.0;  ///< largest angle between the board's planes in two views
  std::vector<IntrinsicsView> views;
  Coverage coverage{};
  std::vector<std::string> uncovered;  ///< names of the parts of the image without corners
};

/// Zhang's method (2000): intrinsics from views of a planar board, all parameters refined together. Views
/// whose residual stands out are left out, at most a quarter of them. `rational`: eight distortion
/// coefficients. Throws Error(kInput) when fewer than three views have the board; anything else that is wrong
/// makes the verdict bad.
IntrinsicsCalibration calibrateIntrinsics(std::span<const BoardView> views, int width, int height,
                                          bool rational);

}  // namespace helical
