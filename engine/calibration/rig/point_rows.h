#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine/calibration/rig/rig_camera.h"

namespace helical {

/// One centroid of a recording.
struct PointRow {
  double time_s = 0.0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  std::int32_t camera = 0;  ///< index into the cameras given
  std::int32_t marker = 0;  ///< index into PointRows::markers
};

struct PointRows {
  std::vector<PointRow> rows;
  std::vector<Eigen::Vector3d> in_body;  ///< of each row [m]; empty where the file has no body coordinates
  std::vector<std::string> markers;      ///< one empty name where the file names no markers
};

/// Called now and then with 0..1.
using ProgressCallback = std::function<void(double)>;

/// Reads `time_s,camera,u_px,v_px[,marker][,body_x_m,body_y_m,body_z_m]`, columns in any order, one header
/// line. Throws Error(kInput) with file, line, what and cure for anything missing, not a number, not finite,
/// of an unknown camera, or that looks like swapped columns.
PointRows readPointRows(const std::filesystem::path& file, std::span<const RigCamera> cameras,
                        const ProgressCallback& progress = {});

}  // namespace helical
