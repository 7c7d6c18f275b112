#pragma once

#include "engine/config/rig_config.h"
#include "engine/experiments/flight_trace.h"
#include "engine/pipeline/snapshot.h"

namespace helical {

/// Makes a FlightTrace of a simulated flight's ticks. One thread.
class TraceRecorder {
 public:
  /// `learner`: the camera whose errors are recorded, with its true place.
  TraceRecorder(const RigConfig& rig, CameraId learner);

  void add(const EngineSnapshot& tick);
  FlightTrace take() { return std::move(trace_); }

 private:
  CameraId learner_;
  RigidTransform true_camera_from_world_;
  FlightTrace trace_;
};

}  // namespace helical
