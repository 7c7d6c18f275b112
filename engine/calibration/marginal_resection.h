#pragma once

#include <span>

#include "engine/calibration/frame_store.h"
#include "engine/geometry/camera_model.h"
#include "engine/helicopter/marker_layout.h"

namespace helical {

struct MarginalResectionOptions {
  int iterations = 20;
  double robust_sigmas = 4.0;  ///< residuals beyond weigh (this / residual)^4; 0 is plain least squares
  bool damped = true;          ///< accept only steps that help (Levenberg-Marquardt); false is Gauss-Newton
};

/// A camera's pose found from frames.
struct MarginalResection {
  RigidTransform camera_from_world;
  Matrix6d information = Matrix6d::Zero();  ///< of the perturbation, order of CameraEstimate
  double cost = 0.0;                        ///< robust, squared sigmas: comparable between poses
  int terms = 0;                            ///< balls that counted
  bool ok = false;                          ///< finite, and determined by the frames
};

/// Minimises the reprojection error (the paper's problem 1 with K known) of the named pixels of all frames
/// over camera_from_world. Each frame's helicopter pose is marginalised with its covariance (Schur
/// complement): its error is common to all balls of the frame. While the fit is still poor the robust scale
/// follows the median residual, so that a guess 15 degrees off is not all outliers. Allocates nothing.
MarginalResection resect(const CameraModel& camera, const MarkerLayout& markers,
                         std::span<const StoredFrame* const> frames, const RigidTransform& initial,
                         const MarginalResectionOptions& options);

}  // namespace helical
