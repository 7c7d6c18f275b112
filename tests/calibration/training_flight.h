#pragma once

#include <cstdint>
#include <vector>

#include "engine/calibration/extrinsic_calibrator.h"
#include "engine/geometry/camera_model.h"
#include "engine/helicopter/marker_layout.h"

namespace helical::test {

struct TrainingFlightOptions {
  double duration_s = 13.0;
  double sigma_px = 0.5;
  double drop_outs = 0.03;
  double outliers = 0.01;  ///< share of pixels moved by up to 80 px each way
  double guess_rotation_rad = 0.2618;
  double guess_position_m = 0.4;
  double pose_position_sigma_m = 0.001;  ///< of the helicopter pose that the calibrator is told, per axis
  double pose_rotation_sigma_rad = 0.003;
  MarkerLayout markers = MarkerLayout::paper();
};

/// A flight seen by one camera that does not know its place, as in the paper's experiment: 60 Hz, on the
/// ground until 1 s, up to 0.6 m by 4 s, then hovering with small motion; two calibrated cameras exist only
/// as the information they give about the helicopter's pose.
struct TrainingFlight {
  struct Frame {
    TimeNs exposure = 0;
    RigidTransform true_world_from_body;
    RigidTransform world_from_body;
    Matrix6d pose_covariance;
    Matrix6d pose_information;  ///< that the calibrated cameras give in this frame alone
    std::vector<LabelledPixel> pixels;
    Observation observation;  ///< the same without names, in an order that changes from frame to frame
    CalibrationFrame view() const {
      return {exposure, world_from_body, pose_covariance, pixels, &observation};
    }
  };

  MarkerLayout markers;
  CameraModel camera;
  RigidTransform camera_from_world;
  RigidTransform guess;
  std::vector<Frame> frames;
};

TrainingFlight flyForTraining(std::uint64_t seed, const TrainingFlightOptions& options = {});

/// Distance between camera centres [m], angle between orientations [rad].
double positionError(const RigidTransform& a, const RigidTransform& b);
double orientationError(const RigidTransform& a, const RigidTransform& b);

}  // namespace helical::test
