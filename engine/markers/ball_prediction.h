#pragma once

#include <Eigen/Core>
#include <array>

#include "engine/base/ids.h"
#include "engine/base/time.h"

namespace helical {

/// Where one ball should be in an image.
struct PredictedBall {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();     ///< of its centre, at the prediction's time
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< px/s
  double radius_px = 0.0;
  double reach_px = 0.0;         ///< its centre is not farther than this from `pixel`
  double reach_rate_px_s = 0.0;  ///< that much farther for each second away from the prediction's time
  bool whole = false;            ///< all of it should be in the image
};

/// All balls of the helicopter in one camera's image. None: nothing is known.
struct BallPredictions {
  TimeNs time = 0;
  int count = 0;
  std::array<PredictedBall, kMaxMarkers> balls{};
};

}  // namespace helical
