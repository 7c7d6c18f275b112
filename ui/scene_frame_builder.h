#pragma once

#include <deque>

#include "engine/config/rig_config.h"
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
  /// The newest state. The caller sets the eye.
  SceneFrame build(const EngineSnapshot& snapshot) const;

 private:
  void addToTrail(const EngineSnapshot& tick);
  void turnRotors(const EngineSnapshot& tick);
  void addRays(const EngineSnapshot& snapshot, int camera, SceneFrame& frame) const;

  struct TrailPoint {
    TimeNs time;
    Eigen::Vector3d position;
  };

  const RigConfig& rig_;
  std::deque<TrailPoint> trail_;
  RigidTransform last_pose_;
  bool ever_tracked_ = false;
  TimeNs last_tick_ = 0;
  double upper_angle_ = 0.0;
  double lower_angle_ = 0.0;
};

}  // namespace helical
