#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/time.h"
#include "engine/geometry/camera_estimate.h"
#include "engine/geometry/camera_model.h"
#include "engine/helicopter/marker_layout.h"
#include "engine/markers/observation.h"
#include "engine/tracking/pose_fit.h"

namespace helical {

/// What is known of the pose before any marker has a name.
struct PosePrior {
  RigidTransform world_from_body;
  double position_radius = 0.3;  ///< m
  double yaw_range = 0.785;      ///< rad, either way
  double yaw_sigma = 0.35;       ///< rad: how well the heading is known within that range
  double tilt_limit = 0.35;      ///< rad
};

/// Finds the helicopter from centroids without names: on the pad at the start, and after every gap in flight.
/// Hypotheses come from the prior (turned in steps all around) and from each camera's hull of four or more
/// centroids: every cyclic shift against the layout's hull, both poses of the planar problem. Each is fitted
/// to all cameras with names by the nearest reprojection; the best robust cost wins, if no distinctly
/// different pose comes near it and none beyond the yaw range fits clearly better. Allocates nothing after
/// construction. One thread.
class Acquisition {
 public:
  Acquisition(const MarkerLayout& markers, std::vector<CameraModel> cameras);

  /// See Tracker.
  void correct(const MarkerLayout& markers, std::span<const CameraModel> cameras);

  /// Keeps the newest observation of each camera.
  void add(const Observation& observation);

  /// A pose at about `time` from the usable cameras' observations of the last 20 ms, if one explains at least
  /// 70 % of what a helicopter would show them, lies within the prior, and is the only one that does.
  std::optional<PoseFit> attempt(TimeNs time, std::span<const CameraEstimate> cameras,
                                 std::span<const bool> usable, const PosePrior& prior);

 private:
  struct Best;
  void consider(const RigidTransform& hypothesis, const PosePrior& prior, Best& best);
  void considerHull(const NamedView& view, const PosePrior& prior, Best& best);
  void name(NamedView& view, const RigidTransform& pose, double gate_px) const;

  MarkerLayout markers_;
  std::vector<CameraModel> cameras_;
  std::array<Observation, kMaxCameras> newest_;
  std::array<bool, kMaxCameras> seen_{};
  std::array<NamedView, kMaxCameras> views_;
  int view_count_ = 0;
  int possible_ = 0;  ///< centroids that a helicopter in full view would show in the present views, at most
};

}  // namespace helical
