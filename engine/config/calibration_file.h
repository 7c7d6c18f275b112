#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/geometry/camera_estimate.h"

namespace helical {

/// Where one camera stands, as a flight or a calibration found it.
struct SavedCamera {
  std::string label;   ///< `id` of the rig file
  std::string method;  ///< by which the pose was found; "given" if nobody did in that flight
  RigidTransform camera_from_world;
  Matrix6d covariance = Matrix6d::Zero();  ///< order of CameraEstimate
  double focal_scale = 1.0;                ///< over the rig file's focal lengths
};

/// A solved calibration. The file has a format of its own (TOML; resources/rigs/README.md), so that the rig file
/// stays as its owner wrote it.
struct SavedCalibration {
  std::string rig;      ///< name of the rig file that it was found with
  std::string written;  ///< date and time, UTC
  double after_s = 0.0;  ///< of the flight, when it was saved
  std::vector<SavedCamera> cameras;
  std::vector<Eigen::Vector3d> markers_in_body;  ///< where a refinement found the balls; empty: as in the rig file
};

/// Errors as `loadRig`.
SavedCalibration loadCalibration(const std::filesystem::path& file);
SavedCalibration parseCalibration(std::string_view toml, const std::string& name);

/// Replaces the file, which is either the old or the new one, never half of it. Throws Error(kSystem).
void saveCalibration(const std::filesystem::path& file, const SavedCalibration& calibration);
/// Numbers come back to the last bit.
std::string toToml(const SavedCalibration& calibration);

}  // namespace helical
