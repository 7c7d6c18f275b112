#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/calibration/rig/instants.h"
#include "engine/calibration/rig/point_rows.h"
#include "engine/calibration/rig/rig_camera.h"

namespace helical {

/// What a recording shows.
enum class TargetKind {
  kBody,          ///< points known in a body's frame: a board, the helicopter
  kMarkers,       ///< named points that move
  kStillMarkers,  ///< named points that stand still
  kLight,         ///< one waved light
};

const char* nameOf(TargetKind kind);

/// One camera's view of one point.
struct Sighting {
  std::int32_t item = 0;  ///< a body's pose at one time, or a point at one time
  std::int32_t camera = 0;
  std::int32_t marker = 0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Vector2d bearing = Eigen::Vector2d::Zero();  ///< x/z, y/z
  Eigen::Vector3d in_body = Eigen::Vector3d::Zero();  ///< metres; of a body's point
  PixelMotion motion;                                 ///< along the camera's own track
  bool inlier = false;
  bool adrift =
      false;  ///< its camera saw later, and how it moves is unknown: so is where it was at its stamp
};

/// How rows of cameras that were not exposed at the same instants are brought together.
enum class Timing {
  kTogether,     ///< rows of the same time stamp, or as near as clocks tell
  kInterpolated  ///< every camera's track is interpolated to common instants
};

/// Rows brought together: sightings of the same item belong to each other. Sorted by item, then camera.
struct SightingTable {
  TargetKind kind = TargetKind::kLight;
  Timing timing = Timing::kTogether;
  int items = 0;
  std::vector<Sighting> sightings;
  std::vector<double> item_time_s;
  long unmatched = 0;           ///< rows that no other camera has a counterpart for
  std::vector<long> ambiguous;  ///< of each camera: rows beside another one of the same marker and instant
  int thinned_by = 1;           ///< every how many-th item was kept
  double period_s = 0.0;        ///< between a camera's frames
  /// Of each camera: by how much its stamps are after those of the items that its rows were put to, on
  /// average.
  std::vector<double> stamps_after_s;
  /// How much later than its time stamps say each camera saw, against the first one: see camera_delays.h.
  /// Taken off the pixels. Empty where it was not sought or not found.
  std::vector<double> late_s;
};

/// Tables of one recording, the more likely one first: with equal time stamps in most rows there is one, else
/// one of each timing. Sorts `rows` by time and thins very long recordings. Throws Error(kInput) when no two
/// cameras have rows of the same time.
std::vector<SightingTable> bringTogether(PointRows& rows, std::span<const RigCamera> cameras,
                                         const std::string& file);

}  // namespace helical
