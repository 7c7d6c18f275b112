#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/geometry/camera_model.h"
#include "engine/geometry/rigid_transform.h"

namespace helical {

/// Other programs' files of cameras.
enum class CameraFormat {
  kOpenCv,  ///< cv::FileStorage: camera_matrix, distortion_coefficients; one camera, no pose
  kKalibr,  ///< camchain: cam0, cam1, ...; pinhole with radtan; poses as a chain
  kRos,     ///< camera_info; one camera, no pose
};

struct ExchangedCamera {
  std::string label;
  CameraModel model;
  std::optional<RigidTransform> camera_from_world;
};

/// Image size for files that do not tell it.
struct ImageSize {
  int width = 0, height = 0;
};

/// Which format it is by what is in it. Throws Error(kInput) for none of them, with line and cure.
std::vector<ExchangedCamera> readCameras(std::string_view yaml, const std::string& name,
                                         const std::optional<ImageSize>& size);

/// Throws Error(kInput) for what the format cannot hold: several cameras, a distortion model.
std::string writeCameras(std::span<const ExchangedCamera> cameras, CameraFormat format);

}  // namespace helical
