#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "engine/base/ids.h"
#include "engine/base/time.h"
#include "engine/geometry/camera_estimate.h"
#include "engine/helicopter/helicopter_state.h"
#include "engine/markers/observation.h"

namespace helical {

/// The helicopter's estimated state at one time. `pose_covariance` is of (position in world [m], rotation
/// vector on the right of world_from_body [rad]).
struct TrackedState {
  TimeNs time = 0;
  HelicopterState state;
  Matrix6d pose_covariance = Matrix6d::Identity();
};

/// How one marker fared in one camera's newest frame.
struct MarkerTrack {
  bool observed = false;                                  ///< a centroid was named after it
  bool agrees = false;                                    ///< and lay inside the gate of its prediction
  bool selected = false;                                  ///< and that centroid was used for the pose
  bool predicted = false;                                 ///< `reprojected` is valid
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();        ///< the centroid
  Eigen::Vector2d reprojected = Eigen::Vector2d::Zero();  ///< from the pose after the update
};

/// What the tracker made of one observation.
struct CameraTrack {
  TimeNs exposure = 0;
  int predicted_count = 0;  ///< balls that should be in the image
  int agreeing_count = 0;
  int selected_count = 0;
  double residual_px = 0.0;  ///< RMS per axis of the selected ones, after the update; 0 when none
  std::array<MarkerTrack, kMaxMarkers> markers{};
};

}  // namespace helical
