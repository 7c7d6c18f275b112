#pragma once

#include <array>
#include <span>

#include "engine/correspondence/prediction_naming.h"
#include "engine/geometry/camera_estimate.h"
#include "engine/geometry/camera_model.h"
#include "engine/helicopter/marker_layout.h"
#include "engine/markers/observation.h"

namespace helical {

/// One camera's centroids with names, for a fit of the pose.
struct NamedView {
  const CameraModel* camera = nullptr;
  RigidTransform camera_from_world;
  const Observation* observation = nullptr;
  Names names{};
};

/// Helicopter pose from named centroids of several cameras.
struct PoseFit {
  RigidTransform world_from_body;
  Matrix6d information = Matrix6d::Zero();  ///< per px^2, order as TrackedState::pose_covariance
  double rms_px = 0.0;                      ///< per axis, of the inliers
  int named = 0;
  int inliers = 0;  ///< residual below `inlier_px`
  bool ok = false;
};

/// Minimises the reprojection error (the paper's eq. 3 with cameras and markers known) over the helicopter's
/// pose by Gauss-Newton with redescending weights: 1 up to `scale_px`, (scale / residual)^4 beyond;
/// `scale_px` = 0 is plain least squares. Allocates nothing.
PoseFit fitPose(std::span<const NamedView> views, const MarkerLayout& markers, const RigidTransform& initial,
                double scale_px, int iterations, double inlier_px);

}  // namespace helical
