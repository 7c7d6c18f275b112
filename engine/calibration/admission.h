#pragma once

#include "engine/base/time.h"
#include "engine/calibration/extrinsic_calibrator.h"
#include "engine/geometry/camera_model.h"
#include "engine/helicopter/marker_layout.h"

namespace helical {

/// When a camera may be flown on. Every pair has a gap between the two limits, so that a camera on the edge
/// does not go in and out.
struct AdmissionOptions {
  double admit_uncertainty_m = 0.008;  ///< standard deviation at the helicopter, below which it may come in
  double drop_uncertainty_m = 0.03;
  double admit_residual = 2.0;  ///< in standard deviations expected; a good camera has 0.7 to 1.2
  double drop_residual = 5.0;
  double window_s = 0.5;  ///< what "now" means; also the least time of good frames before it comes in
  double reach_m = 0.3;   ///< how far around the helicopter the uncertainty must hold
};

/// Throws Error(kInput) naming the offending key.
void validate(const AdmissionOptions& options);

/// How far off, across the line of sight, a camera's own covariance puts a point near the helicopter: the
/// largest standard deviation [m] over the helicopter's place and six points `reach_m` around it. At the
/// place alone a camera that has seen nothing else always looks certain.
double uncertaintyAround(const CameraModel& camera, const CameraEstimate& estimate,
                         const Eigen::Vector3d& helicopter_in_world, double reach_m);

/// Median (the lower of two) over the balls of the distance between pixel and prediction, each in standard
/// deviations of what centroid, helicopter pose and camera estimate together allow, scaled so that it is
/// about 1 for errors as expected. Negative if there are fewer than three balls: too few to judge by.
double normalisedResidual(const CameraModel& camera, const MarkerLayout& markers,
                          const CameraEstimate& estimate, const CalibrationFrame& frame);

/// What the rule remembers of one camera.
struct AdmissionMemory {
  CameraStatus status = CameraStatus::kCalibrating;
  double residual = 0.0;    ///< running mean over the window
  double observed_s = 0.0;  ///< judged time that the mean rests on, up to the window
  double good_s = 0.0;      ///< for how long all limits of coming in have held
  TimeNs last = 0;
};

/// What the rule looks at in one frame.
struct AdmissionEvidence {
  TimeNs exposure = 0;
  double uncertainty_m = 0.0;
  double residual = -1.0;  ///< negative: none in this frame
};

/// The one rule for all methods: kCalibrating or kRejected becomes kCalibrated when uncertainty and mean
/// residual have been below their limits for a window; kCalibrated becomes kRejected when the mean residual
/// passes its limit, and kCalibrating when only the uncertainty does. Frames without a residual change
/// nothing. Pure.
AdmissionMemory admit(const AdmissionOptions& options, const AdmissionMemory& before,
                      const AdmissionEvidence& evidence);

}  // namespace helical
