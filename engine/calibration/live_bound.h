#pragma once

#include <optional>
#include <vector>

#include "engine/calibration/cramer_rao.h"
#include "engine/calibration/extrinsic_calibrator.h"

namespace helical {

/// What the cameras know together of one frame of a camera that is being calibrated.
struct BoundFrame {
  RigidTransform world_from_body;
  Matrix6d pose_information = Matrix6d::Zero();  ///< of the helicopter's pose, from the other cameras
  int balls = 0;                                 ///< that the camera saw, whichever
  double sigma_px = 0.5;                         ///< of a centroid, per axis
  double weight = 1.0;                           ///< how many such frames it stands for
};

/// The Cramer-Rao bound of one camera while it is being calibrated, linearised at its estimate. Frames wait,
/// thinned when they are many, until the estimate is good enough to linearise at; from then on each costs the
/// same. An estimate that jumps afterwards means that the camera was moved, or was somewhere else all along:
/// the bound begins anew. Allocates at construction only. One thread.
class LiveBound {
 public:
  LiveBound();

  void add(const CameraModel& camera, const MarkerLayout& markers, const CameraEstimate& estimate,
           const BoundFrame& frame);

  void restart();

  std::optional<CalibrationBound> bound() const { return bound_.bound(); }

 private:
  void take(const CameraModel& camera, const MarkerLayout& markers, const RigidTransform& camera_from_world,
            const BoundFrame& frame);
  void wait(const BoundFrame& frame);

  CramerRaoBound bound_;
  std::vector<BoundFrame> waiting_;
  double stride_ = 1.0;   ///< frames that a waiting one stands for
  double skipped_ = 0.0;  ///< since the last waiting one
  bool settled_ = false;
  RigidTransform reference_;  ///< where it is linearised, about
};

}  // namespace helical
