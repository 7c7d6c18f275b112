#pragma once

#include <array>
#include <span>
#include <utility>

#include "engine/config/rig_config.h"
#include "engine/flight/system_health.h"
#include "engine/markers/observation.h"
#include "engine/pipeline/clock_watch.h"
#include "engine/pipeline/snapshot.h"

namespace helical {

/// Watches what the flight thread is fed: which cameras are alive, how many of their frames and of the
/// control ticks come, whether the pose explains what the cameras see. Knows of times only what it is told,
/// so that a replay comes to the same. One thread; allocates nothing after construction.
class HealthMonitor {
 public:
  explicit HealthMonitor(const RigConfig& rig);

  void onObservation(const Observation& observation, TimeNs now);
  /// Each sends the frames of the other from now on.
  void exchange(CameraId a, CameraId b) {
    std::swap(cameras_[static_cast<std::size_t>(a.index())], cameras_[static_cast<std::size_t>(b.index())]);
  }
  /// The stamps of its newest frame are wrong: what it shows was somewhere else.
  bool clockHasJumped(CameraId camera) const {
    return cameras_[static_cast<std::size_t>(camera.index())].clock.hasJumped();
  }

  /// Once at each control tick. `usable`: cameras of the control set; `last`: the state after the last tick,
  /// with the newest tracks.
  SystemHealth onTick(TimeNs now, std::span<const bool> usable, const EngineSnapshot& last,
                      const DeviceStatus& devices);

 private:
  struct Camera {
    bool seen = false;
    std::uint64_t last_sequence = 0;
    TimeNs last_seen = 0;
    double came = 0.0;      ///< frames, those long ago fading
    double missing = 0.0;   ///< likewise
    double interval = 0.0;  ///< between frames, smoothed [s]
    ClockWatch clock;
  };
  bool isSilent(const Camera& camera, TimeNs now) const;
  void watchCameras(TimeNs now, std::span<const bool> usable, SystemHealth& health) const;
  void watchTicks(TimeNs now, SystemHealth& health);
  void watchPose(TimeNs now, std::span<const bool> usable, const EngineSnapshot& last, SystemHealth& health);

  SupervisorOptions options_;
  double period_s_;
  double unambiguous_yaw_;  ///< rad; beyond it a symmetric layout may stand otherwise than it seems
  std::array<Camera, kMaxCameras> cameras_{};
  TimeNs last_tick_ = -1;
  double ticks_came_ = 0.0;
  double ticks_due_ = 0.0;
  double residual_ = 0.0;        ///< smoothed [px]
  double usual_residual_ = 0.0;  ///< its baseline [px]; 0: none yet
};

}  // namespace helical
