#pragma once

#include <array>

#include "engine/base/latency_histogram.h"
#include "engine/config/rig_config.h"
#include "engine/flight/autopilot.h"
#include "engine/markers/ball_prediction.h"
#include "engine/pipeline/cable_watch.h"
#include "engine/pipeline/control_set.h"
#include "engine/pipeline/health_monitor.h"
#include "engine/pipeline/snapshot.h"
#include "engine/tracking/tracker.h"

namespace helical {

/// The server of the paper's figure 3: observations in, stick positions out. Owns tracker and autopilot;
/// knows nothing of threads, devices or images, so that real time, lock step and replay run the same code.
/// One thread; allocates nothing after construction.
class FlightLoop {
 public:
  FlightLoop(const RigConfig& rig, const FlightPlan& plan);

  /// One camera's observation, at its use. Any order of cameras; a camera's own in order. One whose cable is found at
  /// another camera's place counts as of that one from then on.
  void onObservation(const Observation& observation, TimeNs now);

  /// One control tick: the sticks to send now.
  const StickDemand& onTick(TimeNs now, const OperatorCommands& commands, const DeviceStatus& devices = {});

  /// The operator hides a camera: its observations count as frames, but nothing they show is used.
  void hideCamera(CameraId camera, bool hidden) { control_set_.hide(camera, hidden); }

  /// The operator's changes between two ticks: see Autopilot.
  void swapPlan(FlightPlan& plan);
  void setControl(const ControllerOptions& control);

  /// As ControlSet has them.
  const char* orderCalibration(const CalibrationOrder& order) { return control_set_.obey(order); }
  void swapCalibration(CameraId camera, std::unique_ptr<CameraCalibration>& calibration) {
    control_set_.swapCalibration(camera, calibration);
  }
  const CameraCalibration* calibration(CameraId camera) const { return control_set_.calibration(camera); }

  /// The camera at the other end of a stream's cable.
  CameraId cameraOf(CameraId stream) const { return cables_.cameraOf(stream); }
  /// What the tracker made of the last observation.
  const CameraTrack& lastTrack() const { return snapshot_.cameras[last_used_].track; }

  /// Where the balls should be in the images of a stream, after the last tick; nothing while that is not known.
  BallPredictions expectedBalls(CameraId stream) const;

  /// State after the last tick.
  const EngineSnapshot& snapshot() const { return snapshot_; }

 private:
  struct CameraCounters {
    bool seen = false;
    std::uint64_t last_sequence = 0;
    TimeNs window_start = 0;
    std::uint64_t window_frames = 0;
    TimeNs unused_arrival = -1;  ///< of the newest frame that no command has used yet
  };
  void use(const Observation& observation, TimeNs now);
  void watchCables(const Observation& observation);
  void exchangeStreams(CameraId a, CameraId b);
  void count(const Observation& observation, TimeNs now);
  void measureRates(TimeNs now);
  void fillSnapshot(TimeNs now, const AutopilotOutput& output);

  RigConfig rig_;
  std::unique_ptr<Tracker> tracker_;
  ControlSet control_set_;
  CableWatch cables_;
  Observation of_its_camera_;
  std::size_t last_used_ = 0;  ///< the camera of the last observation
  HealthMonitor health_;
  Autopilot autopilot_;
  EngineSnapshot snapshot_;
  std::array<CameraCounters, kMaxCameras> counters_;
  std::array<LatencyHistogram, kMaxCameras> extraction_time_;
  LatencyHistogram server_time_;
  LatencyHistogram frame_to_command_;
  TimeNs work_since_tick_ = 0;
  TimeNs pose_time_ = 0;  ///< when an observation last gave a pose
  bool airborne_ = false;
  TimeNs started_ = -1;
};

}  // namespace helical
