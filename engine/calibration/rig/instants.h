#pragma once

#include <vector>

#include "engine/calibration/rig/point_rows.h"

namespace helical {

/// How a track moves through a pixel: its parabola there [px/s, px/s^2]. Zero where no neighbour tells.
struct PixelMotion {
  bool known = false;
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  Eigen::Vector2d acceleration = Eigen::Vector2d::Zero();
};

/// A row at the instant (an integer) that it belongs to.
struct InstantRow {
  PointRow row;
  Eigen::Vector3d in_body = Eigen::Vector3d::Zero();
  std::int64_t instant = 0;
  PixelMotion motion;
};

/// How the cameras' clocks and exposures stand to each other.
struct Rhythm {
  double period_s = 0.0;       ///< median between a camera's frames
  double shared_stamps = 0.0;  ///< share of frames whose time stamp another camera has, too
  double fewest_shared_stamps = 1.0;  ///< the same of the camera that has the fewest of them
};

Rhythm rhythmOf(const PointRows& rows, int cameras);

/// Rows within `window_s` of each other get the same instant. `rows` are in order of time.
std::vector<InstantRow> clusterInTime(const PointRows& rows, double window_s);

/// Each camera's track of each marker, linearly interpolated to instants `period_s` apart. A gap of more than
/// two and a half periods is not bridged, nor a jump far beyond the track's usual step: one end of it is no
/// marker.
std::vector<InstantRow> interpolateInTime(const PointRows& rows, double period_s);

/// Fills in how each row's track moves, from the rows before and after it that interpolateInTime would
/// bridge.
void measureMotion(std::vector<InstantRow>& rows, double period_s);

}  // namespace helical
