#pragma once

#include <array>

#include "engine/base/latency_histogram.h"
#include "engine/calibration/live_bound.h"
#include "engine/config/rig_config.h"
#include "engine/flight/autopilot.h"
#include "engine/pipeline/camera_calibration.h"
#include "engine/pipeline/snapshot.h"
#include "engine/tracking/tracker.h"

namespace helical {

/// The server of the paper's figure 3: observations in, stick positions out. Owns tracker and autopilot;
/// knows nothing of threads, devices or images, so that real time, lock step and replay run the same code.
/// One thread; allocates nothing after construction.
class FlightLoop {
 public:
  FlightLoop(const RigConfig& rig, const FlightPlan& plan);

  /// One camera's observation, at its use. Any order of cameras; a camera's own in order.
  void onObservation(const Observation& observation, TimeNs now);

  /// One control tick: the sticks to send now.
  const StickDemand& onTick(TimeNs now, const OperatorCommands& commands);

  /// The operator hides a camera: its observations count as frames, but nothing they show is used.
  void hideCamera(CameraId camera, bool hidden);

  /// Puts another calibration in the place of a camera's own and hands that back: the camera leaves the
  /// control set until the new one is admitted. For cameras that have one; allocates and frees nothing.
  void swapCalibration(CameraId camera, std::unique_ptr<CameraCalibration>& calibration);
  /// Null for a camera whose pose was given.
  const CameraCalibration* calibration(CameraId camera) const;

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
  void calibrate(const Observation& observation);
  void addToBound(const Observation& observation, const RigidTransform& world_from_body);
  void count(const Observation& observation, TimeNs now);
  void measureRates(TimeNs now);
  void fillSnapshot(TimeNs now, const AutopilotOutput& output);

  RigConfig rig_;
  std::unique_ptr<Tracker> tracker_;
  std::unique_ptr<Tracker> teacher_;  ///< sees with given poses alone; null when nobody learns from it
  Autopilot autopilot_;
  EngineSnapshot snapshot_;
  std::array<CameraEstimate, kMaxCameras> estimates_;
  std::array<std::unique_ptr<CameraCalibration>, kMaxCameras>
      calibrations_;  ///< of cameras with a first guess
  std::array<LiveBound, kMaxCameras> bounds_;
  std::array<bool, kMaxCameras> usable_{};
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
