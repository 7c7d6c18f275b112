#pragma once

#include <Eigen/Core>
#include <span>

#include "engine/base/ids.h"
#include "engine/base/time.h"
#include "engine/correspondence/tried_labellings.h"
#include "engine/geometry/camera_estimate.h"
#include "engine/geometry/camera_model.h"
#include "engine/geometry/rigid_transform.h"
#include "engine/helicopter/marker_layout.h"
#include "engine/markers/observation.h"

namespace helical {

/// A centroid with its name: one ball in the image of the camera that is being calibrated.
struct LabelledPixel {
  MarkerId marker;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = 0.25 * Eigen::Matrix2d::Identity();  ///< px^2
};

/// What one frame of an un-calibrated camera teaches: centroids at its own exposure time, and the
/// helicopter's pose predicted to that time from the other cameras alone. `pose_covariance` is in the order
/// of TrackedState: position in the world [m], then rotation vector on the right of world_from_body [rad].
struct CalibrationFrame {
  TimeNs exposure = 0;
  RigidTransform world_from_body;
  Matrix6d pose_covariance = Matrix6d::Zero();
  std::span<const LabelledPixel> pixels;     ///< named elsewhere; empty for methods that name for themselves
  const Observation* observation = nullptr;  ///< all that the camera saw, without names, for those that do
};

/// One hypothesis of where the camera is.
struct WeightedPose {
  RigidTransform camera_from_world;
  double weight = 0.0;  ///< all of them sum to 1
};

/// Where a fixed camera is, learnt from a helicopter whose pose and markers are known (section III of the
/// paper). Implementations repeat bit for bit for the same seed and frames, and allocate nothing after
/// construction. One thread.
class ExtrinsicCalibrator {
 public:
  virtual ~ExtrinsicCalibrator() = default;

  /// As in the rig file and on the command line.
  virtual const char* name() const = 0;

  /// Forgets everything and starts from a guess of camera_from_world.
  virtual void restart(const RigidTransform& initial_guess) = 0;

  /// Balls and focal lengths were found to be these: frames to come, and those that it still has, are read by them.
  virtual void correct(const CameraModel& camera, const MarkerLayout& markers) = 0;

  /// Takes in one frame. A frame with too few pixels for the method is data, not an error.
  virtual void step(const CalibrationFrame& frame) = 0;

  /// Learns on from an estimate that others found from frames up to now, instead of its own. False for methods that
  /// cannot, and while it does not know its place: it is as it was.
  virtual bool goOnFrom(const CameraEstimate&) { return false; }

  /// Pose and covariance as of the last step, always with status kCalibrating: which camera may be used is
  /// decided by one rule for all methods (engine/calibration/admission.h).
  virtual CameraEstimate estimate() const = 0;

  /// Whether it names centroids for itself: it then takes `CalibrationFrame::observation` and needs neither
  /// pixels nor a good guess.
  virtual bool namesCentroids() const { return false; }

  /// Whether the estimate is one place, not the likeliest of several that are still being tried.
  virtual bool knowsItsPlace() const { return true; }

  /// The pixels of the last step, for methods that name centroids for themselves: empty while it does not
  /// know the names. Valid until the next call.
  virtual std::span<const LabelledPixel> named() const { return {}; }

  /// What it weighs up, or has, for methods that name centroids for themselves.
  virtual TriedLabellings labellings() const { return {}; }

  /// Whether the estimate's covariance already includes what offsets that stay for many frames do to it.
  virtual bool coversLastingOffsets() const { return false; }

  /// The hypotheses behind the estimate, for methods that have them; valid until the next call.
  virtual std::span<const WeightedPose> particles() const { return {}; }

  /// 1 / sum of squared weights; 0 for methods without hypotheses.
  virtual double effectiveSampleSize() const { return 0.0; }
};

}  // namespace helical
