#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/calibration/rig/point_rows.h"
#include "engine/calibration/rig/rig_camera.h"
#include "engine/calibration/rig/sightings.h"
#include "engine/calibration/self_calibration_options.h"
#include "engine/geometry/camera_estimate.h"

namespace helical {

/// Two cameras (indices) and how far apart their centres are.
struct KnownDistance {
  std::size_t a = 0, b = 0;
  double metres = 0.0;
};

struct RigCalibrationOptions {
  std::optional<KnownDistance> scale;
  bool trust_stamps =
      false;  ///< cameras were triggered together, or stamps tell of exposures: no delay is sought
  SelfCalibrationOptions self;  ///< of a body's points and the focal lengths
};

enum class RigVerdict { kGood, kUsable, kBad };
const char* nameOf(RigVerdict verdict);

/// A camera fits the others only before, or only after, an instant of the recording.
struct CameraMove {
  double at_s = 0.0;
  bool fits_before = false;
};

struct CalibratedCamera {
  std::string label;
  bool given = false;                               ///< its pose was given and stands
  std::optional<RigidTransform> camera_from_world;  ///< nothing: it could not be placed
  std::optional<Matrix6d> covariance;               ///< of CameraEstimate's perturbation
  double reprojection_rms_px = 0.0;                 ///< length of the residual, over the inliers
  long observations = 0;                            ///< sightings that took part, rejected ones included
  long rejected = 0;
  double near_misses = 0.0;  ///< what twice as wide a gate would let in besides, over the inliers
  std::optional<CameraMove> moved;
  double position_sigma_m = 0.0;  ///< largest axis
  double orientation_sigma_deg = 0.0;
  double distance_m = 0.0;    ///< median, to what it saw
  int image_parts = 0;        ///< of 16 parts of the image, those with inliers
  /// It saw so much later than its time stamps say, against the first one that is placed; nothing for one
  /// that is not, which was compared with others.
  std::optional<double> late_s = 0.0;
  bool beyond_reach = false;  ///< or even later: more than a frame cannot be told
  double focal_scale = 1.0;   ///< over the given focal lengths
  std::optional<double> focal_sigma =
      0.0;  ///< of that; 0: it is given; nothing: the recording leaves it open
  double focal_off = 0.0,
         focal_off_sigma = 0.0;  ///< what the recording says of a given one, as a share; 0: nothing
};

/// A point of the target's body, where points are solved for.
struct CalibratedPoint {
  Eigen::Vector3d given, found;
  std::optional<double> sigma_m;  ///< largest axis; nothing: the recording leaves it open
};

struct RigCalibration {
  RigVerdict verdict = RigVerdict::kBad;
  std::vector<std::string> reasons;  ///< why the verdict is not better
  bool metric = false;               ///< else the unit of length is arbitrary
  std::string scale_from;
  std::string world;  ///< which frame poses are in
  TargetKind target = TargetKind::kLight;
  Timing timing = Timing::kTogether;
  int items = 0;  ///< points or body poses that took part
  int thinned_by = 1;
  long unmatched = 0;
  double sigma_px = 0.0;      ///< of a pixel, per axis
  bool along_a_line = false;  ///< no camera saw the target leave one
  bool delays = false;        ///< cameras were not exposed together: their `late_s` is taken off
  double focal_share = 0.0;  ///< how far focal lengths that fit better would move a camera, over its distance
  double given_off_deg = 0.0;    ///< how far given poses and the recording disagree
  double given_off_share = 0.0;  ///< the same of places, over the distance to what was seen
  SelfCalibrationOptions self;   ///< what was solved for beside poses
  std::vector<CalibratedPoint> points;
  std::vector<CalibratedCamera> cameras;
};

/// Every pose that `cameras` leave out, from a recording. World: that of given poses, else the first camera's
/// frame. Scale: two or more given poses, body coordinates, `options.scale`, else arbitrary. With
/// `options.self` a body's points and the focal lengths are solved for, too, near what was given; the world
/// is then the same, and the body's frame and, without two given poses, its size are held by the priors
/// alone. Throws Error(kInput) for scales that contradict each other and recordings without rows of the same
/// time; everything else that is wrong with a recording makes the verdict bad. Repeats bit for bit.
RigCalibration calibrateRig(std::span<const RigCamera> cameras, PointRows rows, const std::string& file,
                            const RigCalibrationOptions& options, const ProgressCallback& progress = {});

}  // namespace helical
