#pragma once

#include <vector>

#include "engine/base/random.h"
#include "engine/calibration/rig/point_rows.h"
#include "engine/calibration/rig/rig_camera.h"

namespace helical {

/// What a made-up recording shows and how well.
struct RecordingOptions {
  int cameras = 4;
  double duration_s = 10.0;
  double rate_hz = 30.0;
  double sigma_px = 0.5;
  double outliers = 0.0;  ///< share of rows thrown up to 80 px aside
  double jitter_s = 0.0;  ///< each exposure is off by up to it; time stamps tell the truth
  double dropout = 0.05;
  bool together = true;  ///< else each camera exposes at a time of its own
  Eigen::Vector3d reach{1.0, 1.0, 1.0};  ///< of the hand's way, over the usual one
  std::vector<double>
      late_s;  ///< of each camera: it exposes so much later than its stamps say; empty: at them
};

/// Cameras on a circle of 3 m about the origin, 1 to 2 m high, looking at its middle, with true poses and
/// distortion. Times of exposure, and the light, markers or board that they saw.
struct MadeRecording {
  std::vector<RigCamera> cameras;  ///< with their true poses
  PointRows rows;

  /// The same cameras without poses.
  std::vector<RigCamera> unposed() const;
};

MadeRecording wavedLight(const RecordingOptions& options, std::uint64_t seed);
MadeRecording namedMarkers(const RecordingOptions& options, std::uint64_t seed);  ///< five of them on a wand
MadeRecording stillMarkers(const RecordingOptions& options, std::uint64_t seed);  ///< sixty, on walls
MadeRecording wavedBoard(const RecordingOptions& options, std::uint64_t seed);    ///< 6x4 corners of 60 mm

/// Largest errors of solved poses after the best rigid (and, if asked, scaled) alignment to the truth.
struct PoseErrors {
  double degrees = 0.0, metres = 0.0;
};
PoseErrors poseErrors(const std::vector<RigCamera>& truth,
                      const std::vector<std::optional<RigidTransform>>& solved, bool scaled);

}  // namespace helical
