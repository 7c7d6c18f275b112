#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/calibration/calibrator_factory.h"
#include "engine/calibration/self_calibration_options.h"
#include "engine/cameras/device_options.h"
#include "engine/flight/controller_options.h"
#include "engine/flight/supervisor_options.h"
#include "engine/geometry/camera_estimate.h"
#include "engine/geometry/camera_model.h"
#include "engine/geometry/rigid_transform.h"
#include "engine/helicopter/helicopter_parameters.h"
#include "engine/helicopter/marker_layout.h"
#include "engine/markers/ignored_areas.h"
#include "engine/markers/marker_options.h"
#include "engine/simulator/simulation_options.h"
#include "engine/tracking/tracker_options.h"
#include "engine/transmitter/transmitter_options.h"

namespace helical {

struct CameraConfig {
  std::string label;   ///< `id` of the rig file: what users call it
  std::string name;    ///< shown as title; "Camera <id>" if the file gives none
  std::string source;  ///< "sim", "aravis:ADDRESS-OR-SERIAL", or empty in a rig for recordings
  DeviceOptions device;  ///< of a source that is a device
  CameraModel model;
  double focal_scale = 1.0;  ///< of the model's focal lengths over the rig file's: see replaceFocalLengths
  std::optional<RigidTransform> camera_from_world;  ///< nothing: un-calibrated
  bool pose_is_guess = false;                       ///< `initial = true`
  std::optional<Matrix6d> pose_covariance;          ///< of CameraEstimate's perturbation, if the file tells
  IgnoredAreas ignored_areas;                       ///< no marker is looked for there

  /// Whether its pose has to be found in flight.
  bool learns() const { return !camera_from_world || pose_is_guess; }
};

/// A rig file, loaded and validated. Immutable after.
struct RigConfig {
  std::string path;
  std::vector<CameraConfig> cameras;
  MarkerLayout markers_in_body = MarkerLayout::paper();
  HelicopterParameters helicopter = HelicopterParameters::xrb();
  MarkerOptions marker_options;
  TrackerOptions tracking;
  ControllerOptions control;
  SupervisorOptions safety;
  TransmitterOptions transmitter;
  SimulationOptions simulation;
  std::string tracker = "helical";  ///< or "paper", to compare with
  /// Cameras learn from any pose, also one that they helped to find: what the paper does after the switch.
  /// Otherwise only from a pose that other cameras vouch for.
  bool learn_from_own_pose = false;
  std::string calibrator = "joint";  ///< of cameras whose pose has to be found in flight
  CalibratorOptions calibration;
  SelfCalibrationOptions self_calibration;  ///< of refinements

  /// The camera that users call `label`; throws Error(kInput) listing the rig's cameras.
  CameraId camera(const std::string& label) const;

  /// A calibration has found balls and focal lengths to be these; the simulated field stays as it was. Throws
  /// Error(kInput) for another number of balls.
  void replaceMarkers(std::span<const Eigen::Vector3d> markers_in_body);
  void replaceFocalLengths(std::size_t camera, double scale);
};

}  // namespace helical
