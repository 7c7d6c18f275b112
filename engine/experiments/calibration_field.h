#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/calibration/cramer_rao.h"
#include "engine/calibration/extrinsic_calibrator.h"
#include "engine/calibration/rig_moment.h"
#include "engine/helicopter/marker_layout.h"

namespace helical {

struct CalibrationFieldOptions {
  MarkerLayout markers;
  std::vector<Eigen::Vector3d> true_markers;  ///< where the balls really are; empty: where `markers` says
  double duration_s = 13.0;
  double rate_hz = 60.0;
  double sigma_px = 0.5;           ///< of centroids, per axis, white
  double drop_outs = 0.03;         ///< share of balls that are not found
  double outliers = 0.01;          ///< share of centroids moved by up to 80 px each way, in every camera
  double guess_rotation = 0.2618;  ///< rad
  double guess_position = 0.4;     ///< m
};

/// A flight before three cameras as in the paper's experiments, without images: cameras 2.3 to 3.2 m away at
/// 30 to 50 degrees of elevation, the first two calibrated, the third not; the helicopter on the ground until
/// 1 s, up to 0.6 m by 4 s, then hovering with small motion. Its pose in each frame is fitted to what the
/// first two cameras see in that frame alone. Repeats for a seed.
struct CalibrationField {
  struct Frame {
    bool has_pose = false;  ///< the first two cameras saw enough
    RigidTransform world_from_body;
    RigidTransform true_world_from_body;
    Matrix6d pose_covariance = Matrix6d::Zero();
    Observation observation;  ///< of the third camera, without names
    std::array<RigMoment::View, 2> known_views;  ///< of the first two, named
    std::array<LabelledPixel, kMaxMarkers> labelled;
    CalibrationBound bound;  ///< Cramer-Rao, of all frames so far; false balls count as if they were true
    CalibrationBound true_bound;  ///< the same of the true balls alone: who knew which are false could not do better

    CalibrationFrame view() const {
      return {observation.exposure,
              world_from_body,
              pose_covariance,
              {labelled.data(), static_cast<std::size_t>(observation.count)},
              &observation};
    }
  };

  CameraModel camera;
  std::array<RigidTransform, 2> known_cameras;  ///< camera_from_world of the first two
  RigidTransform camera_from_world;
  RigidTransform guess;
  std::vector<Frame> frames;
};

CalibrationField simulateCalibrationField(std::uint64_t seed, const CalibrationFieldOptions& options);

}  // namespace helical
