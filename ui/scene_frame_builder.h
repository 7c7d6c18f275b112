#pragma once

#include <array>
#include <deque>
#include <memory>
#include <vector>

#include "engine/config/rig_config.h"
#include "engine/flight/flight_plan.h"
#include "engine/pipeline/snapshot.h"
#include "ui/scene_frame.h"

namespace helical {

SceneSetup sceneSetup(const RigConfig& rig);

/// Turns the engine's ticks into what the scene shows; remembers the trail and the rotors' angle.
class SceneFrameBuilder {
 public:
  explicit SceneFrameBuilder(const RigConfig& rig);

  /// Every control tick, in order.
  void addTick(const EngineSnapshot& tick);
  /// What a camera's calibrator believes now.
  void setCalibration(int camera, const CalibrationView& view);
  /// Whether the border of what two cameras see is part of the scene.
  void setCoverageShown(bool shown) { coverage_shown_ = shown; }
  /// Waypoints to be shown, above where the helicopter stands; `draft`: not in force yet.
  void setPlan(const FlightPlan& plan, bool draft);
  /// The newest state. The caller sets the eye.
  SceneFrame build(const EngineSnapshot& snapshot);

 private:
  void addToTrail(const EngineSnapshot& tick);
  void turnRotors(const EngineSnapshot& tick);
  void updateCoverage(const SceneFrame& frame);
  double fenceNearness(const SceneFrame& frame) const;
  void addRays(const EngineSnapshot& snapshot, int camera, SceneFrame& frame) const;

  struct TrailPoint {
    TimeNs time;
    Eigen::Vector3d position;
  };

  const RigConfig& rig_;
  std::deque<TrailPoint> trail_;
  std::array<std::vector<SceneParticle>, kMaxCameras> particles_;
  RigidTransform last_pose_;
  std::vector<Eigen::Vector3d> plan_above_pad_;
  bool plan_is_draft_ = false;
  bool coverage_shown_ = true;
  std::vector<SceneCameraPose> covering_;  ///< the cameras that `coverage_` was computed for
  std::shared_ptr<const std::vector<Eigen::Vector3d>> coverage_;
  bool ever_tracked_ = false;
  TimeNs last_tick_ = 0;
  double upper_angle_ = 0.0;
  double lower_angle_ = 0.0;
};

}  // namespace helical
