#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/ids.h"

namespace helical {

/// A simulated flight as the paper's figures 6 to 11 show it, at one control tick.
struct TraceSample {
  double time_s = 0.0;                                  ///< since the session began
  Eigen::Vector3d position = Eigen::Vector3d::Zero();   ///< true, from where it stood on the pad [m]
  Eigen::Vector3d reference = Eigen::Vector3d::Zero();  ///< of the position [m]
  double yaw = 0.0;                                     ///< true [rad]
  double reference_yaw = 0.0;                           ///< rad
  std::array<std::uint16_t, kMaxCameras>
      selected{};  ///< bit m: marker m was used in the camera's newest frame
  /// Of the camera that learns, estimated less true: its centre in world [m], and the rotation vector from
  /// its true axes to the estimated ones [rad].
  Eigen::Vector3d camera_position_error = Eigen::Vector3d::Zero();
  Eigen::Vector3d camera_rotation_error = Eigen::Vector3d::Zero();
};

struct FlightTrace {
  std::string name;  ///< "experiment A": the legend's words
  int camera_count = 0;
  int marker_count = 0;
  int covered_camera = -1;      ///< counted from 0; negative: none
  double covered_from_s = 0.0;  ///< until the landing
  bool crashed = false;
  double crashed_at_s = 0.0;  ///< valid with `crashed`
  std::vector<TraceSample> samples;
};

}  // namespace helical
