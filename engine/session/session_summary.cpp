#include "engine/session/session_summary.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/error.h"
#include "engine/geometry/rotation.h"
#include "engine/session/flight_decoder.h"

namespace helical {
namespace {

constexpr std::uint64_t kMostSamples = 20'000;
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
const Eigen::Vector3d kNowhere = Eigen::Vector3d::Constant(kUnknown);

SessionSample::Camera sampleOf(const CameraSnapshot& camera, int markers) {
  SessionSample::Camera sample;
  const CameraEstimate& estimate = camera.estimate;
  sample.position_error = sample.rotation_error = kNowhere;
  sample.status = estimate.status;
  const bool known = estimate.status != CameraStatus::kUncalibrated;
  if (known && camera.has_truth) {
    sample.position_error =
        estimate.camera_from_world.inverseTranslation() - camera.true_camera_from_world.inverseTranslation();
    sample.rotation_error =
        logSO3(estimate.camera_from_world.rotation * camera.true_camera_from_world.rotation.conjugate());
  }
  sample.orientation_sigma = known ? std::sqrt(estimate.covariance.topLeftCorner<3, 3>().trace()) : kUnknown;
  sample.position_sigma = known ? std::sqrt(estimate.covariance.bottomRightCorner<3, 3>().trace()) : kUnknown;
  sample.position_bound = camera.calibration_bound ? camera.calibration_bound->position_m : kUnknown;
  sample.residual_px = camera.track.selected_count > 0 ? camera.track.residual_px : kUnknown;
  sample.latency_ms = camera.frames > 0 ? 1e-6 * static_cast<double>(camera.latency) : kUnknown;
  sample.effective_sample_size =
      camera.effective_sample_size > 0.0 ? camera.effective_sample_size : kUnknown;
  for (int m = 0; m < markers; ++m)
    if (camera.track.markers[static_cast<std::size_t>(m)].selected)
      sample.selected = static_cast<std::uint16_t>(sample.selected | (1u << m));
  return sample;
}

bool isCovered(const EngineSnapshot& tick, int camera, const std::vector<Occlusion>& occlusions) {
  const CameraSnapshot& state = tick.cameras[static_cast<std::size_t>(camera)];
  return state.hidden || state.boards > 0 ||
         std::any_of(occlusions.begin(), occlusions.end(), [&](const Occlusion& occlusion) {
           return occlusion.covers(cameraId(camera), toSeconds(tick.time));
         });
}

SessionSample sampleOf(const EngineSnapshot& tick, const std::vector<Occlusion>& occlusions) {
  const Eigen::Vector3d pad(0.0, 0.0, tick.pad_height);
  const RigidTransform& tracked = tick.tracked.state.world_from_body;
  const RigidTransform& truth = tick.truth.world_from_body;
  SessionSample sample;
  sample.time_s = toSeconds(tick.time);
  sample.position = tick.pose_known ? Eigen::Vector3d(tracked.translation - pad) : kNowhere;
  sample.yaw = tick.pose_known ? yawOf(tracked.rotation) : kUnknown;
  sample.truth = tick.has_truth ? Eigen::Vector3d(truth.translation - pad) : kNowhere;
  sample.true_yaw = tick.has_truth ? yawOf(truth.rotation) : kUnknown;
  const bool flies = rotorsTurn(tick.phase);
  sample.reference = flies ? Eigen::Vector3d(tick.set_point.position_in_world - pad) : kNowhere;
  sample.reference_yaw = flies ? tick.set_point.yaw : kUnknown;
  const bool both = tick.pose_known && tick.has_truth;
  sample.position_error = both ? (tracked.translation - truth.translation).norm() : kUnknown;
  sample.orientation_error = both ? tracked.rotation.angularDistance(truth.rotation) : kUnknown;
  sample.position_sigma =
      tick.pose_known ? std::sqrt(tick.tracked.pose_covariance.topLeftCorner<3, 3>().trace()) : kUnknown;
  sample.sticks = tick.sticks;
  sample.server_p99_ms = 1e-6 * static_cast<double>(tick.server_p99);
  sample.command_p99_ms = 1e-6 * static_cast<double>(tick.frame_to_command_p99);
  for (int i = 0; i < tick.camera_count; ++i) {
    sample.cameras.push_back(sampleOf(tick.cameras[static_cast<std::size_t>(i)], tick.marker_count));
    sample.cameras.back().covered = isCovered(tick, i, occlusions);
  }
  return sample;
}

}  // namespace

SessionSummary summarize(McapReader& session, const ExportProgress& progress, const ExportSpan& span) {
  SessionSummary summary;
  summary.file = session.file().string();
  summary.settings = fromAttachments(session.attachments(), summary.file);
  summary.complete = session.complete();
  summary.rotors_on_s = kUnknown;
  const TimeNs begin = std::max(span.from, session.firstTime()), end = std::min(span.to, session.lastTime());
  const double length_s = std::max(1e-3, toSeconds(end - begin));
  const auto ticks = static_cast<std::uint64_t>(length_s * summary.settings.rig.control.rate_hz);
  const std::uint64_t stride = 1 + ticks / kMostSamples;
  FlightDecoder decoder(session, summary.settings.rig);
  session.read(withoutImages(session), [&](const McapMessage& message) {
    const FlightDecoder::Found found = decoder.take(message);
    if (found == FlightDecoder::Found::kEvent && span.holds(decoder.event().time))
      summary.events.push_back(decoder.event());
    if (found != FlightDecoder::Found::kTick || !span.holds(decoder.tick().time)) return;
    const EngineSnapshot& tick = decoder.tick();
    if (rotorsTurn(tick.phase) && !(summary.rotors_on_s <= toSeconds(tick.time)))
      summary.rotors_on_s = toSeconds(tick.time);
    summary.score.add(tick);
    if (summary.ticks % stride == 0)
      summary.samples.push_back(sampleOf(tick, summary.settings.rig.simulation.occlusions));
    if (++summary.ticks % 600 == 0) progress(std::min(1.0, toSeconds(tick.time - begin) / length_s));
  });
  if (summary.ticks == 0)
    throw Error(ErrorKind::kInput, "the session holds no moment of a flight, or none in this span", summary.file,
                "give a longer one");
  summary.last = decoder.tick();
  summary.crash_reason = summary.last.verdict.crashed ? summary.last.verdict.reason : "";
  summary.last.verdict.reason = "";
  summary.last.obstacle = summary.last.refusal = nullptr;
  summary.begin_s = summary.samples.front().time_s;
  summary.end_s = summary.samples.back().time_s;
  for (CameraSnapshot& camera : summary.last.cameras) {
    summary.methods.emplace_back(camera.calibration_method != nullptr ? camera.calibration_method : "");
    camera.calibration_method = nullptr;
  }
  std::stable_sort(summary.events.begin(), summary.events.end(),
                   [](const EngineEvent& a, const EngineEvent& b) { return a.time < b.time; });
  return summary;
}

std::vector<SessionSummary> summarizeAll(const std::vector<std::string>& files, const ExportProgress& progress) {
  std::vector<SessionSummary> summaries;
  for (const auto& file : files) {
    McapReader session(file);
    const auto before = static_cast<double>(summaries.size()), all = static_cast<double>(files.size());
    summaries.push_back(summarize(session, [&](double done) { progress((before + done) / all); }));
  }
  return summaries;
}

}  // namespace helical
