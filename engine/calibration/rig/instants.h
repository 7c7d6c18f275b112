#pragma once

#include <vector>

#include "engine/calibration/rig/point_rows.h"

namespace helical {

/// A row at the instant (an integer) that it belongs to.
struct InstantRow {
  PointRow row;
  Eigen::Vector3d in_body = Eigen::Vector3d::Zero();
  std::int64_t instant = 0;
};

/// How the cameras' clocks and exposures stand to each other.
struct Rhythm {
  double period_s = 0.0;       ///< median between a camera's frames
  double shared_stamps = 0.0;  ///< share of frames whose time stamp another camera has, too
};

Rhythm rhythmOf(const PointRows& rows, int cameras);

/// Rows within `window_s` of each other get the same instant. `rows` are in order of time.
std::vector<InstantRow> clusterInTime(const PointRows& rows, double window_s);

/// Each camera's track of each marker, linearly interpolated to instants `period_s` apart. A gap of more than
/// two and a half periods is not bridged, nor a jump far beyond the track's usual step: one end of it is no
/// marker.
std::vector<InstantRow> interpolateInTime(const PointRows& rows, double period_s);

}  // namespace helical
