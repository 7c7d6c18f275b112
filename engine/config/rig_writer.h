#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/geometry/camera_estimate.h"
#include "engine/geometry/camera_model.h"
#include "engine/geometry/rigid_transform.h"

namespace helical {

/// A pose to put into a rig file.
struct WrittenPose {
  std::string label;
  RigidTransform camera_from_world;
  std::optional<Matrix6d> covariance;
};

/// Balls and focal lengths that were found to be others than a rig file has them.
struct RigCorrections {
  std::vector<std::pair<std::string, double>> focal_scales;  ///< of cameras by label, over the file's
  std::vector<Eigen::Vector3d> markers_in_body;              ///< empty: as in the file
};

/// The rig `toml` with these poses in place of its cameras' [camera.pose]; everything else stays as it is,
/// but for comments, and for what `corrections` say. `header` lines become the comment at the top. `name` stands for the file in messages.
std::string rigWithPoses(std::string_view toml, const std::string& name, std::span<const WrittenPose> poses,
                         std::string_view header, const RigCorrections& corrections = {});

/// A rig of cameras that have intrinsics and, maybe, poses.
struct WrittenCamera {
  std::string label;
  CameraModel model;
  std::optional<RigidTransform> camera_from_world;
};
std::string rigOfCameras(std::span<const WrittenCamera> cameras, std::string_view header);

/// Writes a text file as a whole: into a new one that takes its place when it is complete. Throws Error
/// saying what is wrong with the place.
void writeTextFile(const std::filesystem::path& file, std::string_view text);

}  // namespace helical
