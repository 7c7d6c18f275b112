#pragma once

#include <array>

#include "engine/calibration/rig_moment.h"

namespace helical {

/// The named balls in one frame of one camera.
struct NamedBalls {
  TimeNs exposure = 0;
  std::bitset<kMaxMarkers> seen;
  std::array<Eigen::Vector2f, kMaxMarkers> pixels;
  float variance = 0.25F;           ///< per axis [px^2]
  RigidTransform camera_from_body;  ///< as that camera has it, where that is asked for
};

/// Brings what cameras saw at their own times to common times. Keeps each camera's last frames; allocates nothing.
/// One thread.
class MomentMaker {
 public:
  void add(CameraId camera, const NamedBalls& balls);
  void forget();

  /// What cameras that saw balls shortly before and after `time` would have seen then. Returns how many cameras
  /// there are in it. `nearest`, if not null, gets each of those cameras' frame nearest to that time.
  int at(TimeNs time, RigMoment& moment, std::array<const NamedBalls*, kMaxCameras>* nearest = nullptr) const;

 private:
  static constexpr int kKept = 16;
  struct Recent {
    std::array<NamedBalls, kKept> frames;
    int count = 0, next = 0;
  };
  std::array<Recent, kMaxCameras> cameras_;
};

}  // namespace helical
