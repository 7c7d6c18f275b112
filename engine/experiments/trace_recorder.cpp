#include "engine/experiments/trace_recorder.h"

#include "engine/geometry/rotation.h"
#include "engine/pipeline/rig_hardware.h"

namespace helical {

TraceRecorder::TraceRecorder(const RigConfig& rig, CameraId learner)
    : learner_(learner), true_camera_from_world_(trueCameraFromWorld(rig, learner)) {
  trace_.camera_count = static_cast<int>(rig.cameras.size());
  trace_.marker_count = rig.markers_in_body.count();
  if (rig.simulation.occlusions.empty()) return;
  trace_.covered_camera = rig.simulation.occlusions.front().camera.index();
  trace_.covered_from_s = rig.simulation.occlusions.front().from_s;
}

void TraceRecorder::add(const EngineSnapshot& tick) {
  if (!tick.has_truth) return;
  if (tick.verdict.crashed && !trace_.crashed) {
    trace_.crashed = true;
    trace_.crashed_at_s = toSeconds(tick.time);
  }
  const Eigen::Vector3d pad(0.0, 0.0, tick.pad_height);
  TraceSample sample;
  sample.time_s = toSeconds(tick.time);
  sample.position = tick.truth.world_from_body.translation - pad;
  sample.reference = tick.set_point.position_in_world - pad;
  sample.yaw = yawOf(tick.truth.world_from_body.rotation);
  sample.reference_yaw = tick.set_point.yaw;
  for (std::size_t c = 0; c < static_cast<std::size_t>(tick.camera_count); ++c)
    for (std::size_t m = 0; m < static_cast<std::size_t>(tick.marker_count); ++m)
      if (tick.cameras[c].track.markers[m].selected)
        sample.selected[c] = static_cast<std::uint16_t>(sample.selected[c] | 1u << m);
  const RigidTransform& estimated =
      tick.cameras[static_cast<std::size_t>(learner_.index())].estimate.camera_from_world;
  sample.camera_position_error =
      estimated.inverse().translation - true_camera_from_world_.inverse().translation;
  sample.camera_rotation_error = logSO3(estimated.rotation * true_camera_from_world_.rotation.conjugate());
  trace_.samples.push_back(sample);
}

}  // namespace helical
