#pragma once

#include "engine/calibration/frame_store.h"
#include "engine/geometry/camera_model.h"
#include "engine/helicopter/marker_layout.h"
#include "engine/markers/observation.h"

namespace helical {

/// A frame as it came: centroids without names.
struct UnnamedFrame {
  RigidTransform world_from_body;
  Matrix6d pose_covariance = Matrix6d::Zero();
  Observation observation;
};

/// Names the centroids by where a camera at `camera_from_world`, known to `camera_covariance` (order of
/// CameraEstimate), should see the balls. A centroid nowhere near stays without a name. Allocates nothing.
void nameCentroids(const CameraModel& camera, const MarkerLayout& markers,
                   const RigidTransform& camera_from_world, const Matrix6d& camera_covariance,
                   const UnnamedFrame& frame, StoredFrame& named);

}  // namespace helical
