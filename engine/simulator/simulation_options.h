#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/base/ids.h"
#include "engine/geometry/camera_model.h"
#include "engine/geometry/rigid_transform.h"
#include "engine/helicopter/marker_layout.h"

namespace helical {

/// A white board before a camera, from `from_s` to `to_s` of the session.
struct Occlusion {
  CameraId camera;
  double from_s = 0.0;
  double to_s = 0.0;

  bool covers(CameraId which, double time_s) const { return which == camera && time_s >= from_s && time_s < to_s; }
};

/// A knock: at `at_s` the camera turns about a random axis and shifts in a random direction.
struct Bump {
  CameraId camera;
  double at_s = 0.0;
  double angle = 0.0;     ///< rad
  double distance = 0.0;  ///< m
  bool across = false;    ///< the axis lies in the image plane: a turn about the line of sight hardly shows
};

/// Image-free observations: what the extractor makes of rendered images, as numbers. Fitted to the renderer;
/// tests/pipeline compares the two.
struct ObservationNoise {
  double sigma_px = 0.08;         ///< per axis, frame to frame
  double bias_px = 0.08;          ///< per axis, of an offset that changes slowly
  double bias_time_s = 1.0;       ///< correlation time of that offset
  double dropout = 0.0005;        ///< a visible ball is not found
  double false_markers = 0.0001;  ///< per frame: a region somewhere in the image
  // What is done to an observation on top, with images and without.
  double lost_markers = 0.0;  ///< share of balls that are not found
  double outliers = 0.0;      ///< share of centroids thrown up to kOutlierReachPx aside
};
inline constexpr double kOutlierReachPx = 80.0;  ///< per axis, either way

struct SimulationOptions {
  std::uint64_t seed = 1;
  bool images = true;
  double gust_factor = 1.0;
  double vary = 0.0;  ///< fraction, of every helicopter parameter
  double camera_rate_hz = 60.0;
  double rate_error = 1e-4;        ///< relative, drawn per camera: their clocks are not synchronised
  double readout_delay_s = 0.015;  ///< mid-exposure to arrival
  double field_empty_s = 0.25;     ///< before the helicopter is put on the pad: time to take the background
  double image_noise = 2.0;        ///< grey levels, standard deviation
  double light_drift = 0.05;       ///< relative, over half a minute
  double marker_error_m = 0.0;     ///< per axis, drawn: balls are not where the rig says
  double focal_error = 0.0;        ///< share, drawn per camera: focal lengths are not what the rig says
  ObservationNoise noise;
  std::vector<Occlusion> occlusions;
  std::vector<Bump> bumps;
  /// True poses of cameras whose pose the rig file does not give, or gives as a first guess only.
  std::vector<std::optional<RigidTransform>> true_camera_from_world;
  /// What balls and lenses are in truth, but for the errors above, where a saved calibration says otherwise.
  std::optional<MarkerLayout> markers_before;
  std::vector<std::optional<CameraModel>> models_before;
};

/// Throws Error(kInput) naming the offending key.
void validate(const SimulationOptions& options);

}  // namespace helical
