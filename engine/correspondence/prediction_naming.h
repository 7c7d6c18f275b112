#pragma once

#include <Eigen/Core>
#include <array>
#include <span>

#include "engine/base/ids.h"
#include "engine/markers/observation.h"

namespace helical {

/// Where a marker should appear in an image.
struct MarkerPrediction {
  bool visible = false;  ///< in front of the camera and inside the image
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance =
      Eigen::Matrix2d::Identity();  ///< of the innovation: prediction and centroid [px^2]
  double radius_px = 0.0;           ///< of the ball's image
};

/// Index of the centroid named after each marker, or -1.
using Names = std::array<int, kMaxMarkers>;

/// Names centroids by the nearest prediction in Mahalanobis distance, one to one, closest pairs first, inside
/// `gate_chi2`. Two balls whose images touch make one region: where predicted discs overlap, a region too
/// large for one ball names nobody. Allocates nothing.
Names nameByPrediction(std::span<const MarkerPrediction> predictions, const Observation& observation,
                       double gate_chi2);

}  // namespace helical
