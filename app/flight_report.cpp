#include "app/flight_report.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "engine/geometry/rotation.h"

namespace helical {
namespace {

using nlohmann::json;

/// A figure without samples is null, not zero.
json figure(const RunningRms& rms, double scale = 1.0) {
  return rms.count() > 0 ? json(scale * rms.value()) : json(nullptr);
}

json neesJson(const FlightScore& score, double value) {
  return score.neesSamples() > 0 ? json(value) : json(nullptr);
}

json microseconds(TimeNs p50, TimeNs p99) {
  if (p99 == 0) return {{"p50", nullptr}, {"p99", nullptr}};
  return {{"p50", static_cast<double>(p50) * 1e-3}, {"p99", static_cast<double>(p99) * 1e-3}};
}

/// Null, but for the knocks, for a camera that was not calibrated in flight.
json calibrationJson(const FlightRun& run, std::size_t index) {
  json fields;
  for (const char* key :
       {"method", "time_to_1cm_s", "position_error_m", "orientation_error_deg", "position_sigma_m",
        "orientation_sigma_deg", "crlb_position_m", "crlb_orientation_deg", "nees", "bumps_detected"})
    fields[key] = nullptr;
  const CameraSnapshot& camera = run.last.cameras[index];
  fields["bumps_detected"] = camera.knocks_found;
  if (camera.calibration_method == nullptr) return fields;
  fields["method"] = camera.calibration_method;
  if (!camera.has_truth) return fields;
  const CameraError error = cameraError(camera.estimate.camera_from_world, camera.true_camera_from_world);
  const double converged_s = run.score.convergedAfter(cameraId(static_cast<int>(index)));
  fields["time_to_1cm_s"] = converged_s >= 0.0 ? json(converged_s) : json(nullptr);
  fields["position_error_m"] = error.position;
  fields["orientation_error_deg"] = toDegrees(error.orientation);
  fields["position_sigma_m"] = std::sqrt(camera.estimate.covariance.diagonal().tail<3>().sum());
  fields["orientation_sigma_deg"] =
      toDegrees(std::sqrt(camera.estimate.covariance.diagonal().head<3>().sum()));
  if (camera.calibration_bound) {
    fields["crlb_position_m"] = camera.calibration_bound->position_m;
    fields["crlb_orientation_deg"] = toDegrees(camera.calibration_bound->orientation_rad);
  }
  fields["nees"] = calibrationNees(camera.estimate, camera.true_camera_from_world);
  return fields;
}

/// A camera's id as the rig file gives it: a number or a string.
json idJson(const std::string& label) {
  const bool number = label.size() < 10 && std::all_of(label.begin(), label.end(),
                                                       [](unsigned char c) { return std::isdigit(c) != 0; });
  return number ? json(std::stoi(label)) : json(label);
}

json cameraJson(const FlightRun& run, const CameraConfig& config, std::size_t index) {
  const CameraSnapshot& camera = run.last.cameras[index];
  return {{"id", idJson(config.label)},
          {"calibrated", camera.estimate.status == CameraStatus::kCalibrated},
          {"frames", camera.frames},
          {"dropped", camera.dropped},
          {"returns", camera.returns},
          {"resent_packets", camera.resent_packets},
          {"longest_gap_s", run.links.longestGap(cameraId(static_cast<int>(index)))},
          {"extraction_us", microseconds(camera.extraction_p50, camera.extraction_p99)},
          {"focal_scale", camera.focal_scale},
          {"calibration", calibrationJson(run, index)}};
}

std::string outcome(const FlightRun& run) {
  return outcomeOf(run.last, run.score);
}

std::string line(const char* format, auto... values) {
  char buffer[256];
  std::snprintf(buffer, sizeof buffer, format, values...);
  return buffer;
}

}  // namespace

std::string flightJson(const FlightRun& run, const RigConfig& rig) {
  const FlightScore& score = run.score;
  json report;
  report["outcome"] = outcome(run);
  report["crash_reason"] = run.last.verdict.crashed ? json(run.last.verdict.reason) : json(nullptr);
  report["duration_s"] = toSeconds(run.last.time);
  report["simulated_over_wall"] = toSeconds(run.last.time) / run.wall_s;
  report["tracking"] = {{"position_rms_m", figure(score.trackedPosition())},
                        {"orientation_rms_deg", figure(score.trackedOrientation(), toDegrees(1.0))},
                        {"lost_s", score.lostSeconds()},
                        {"nees", neesJson(score, score.nees())},
                        {"nees_parts",
                         {{"horizontal", neesJson(score, score.neesPart(0))},
                          {"vertical", neesJson(score, score.neesPart(1))},
                          {"tilt", neesJson(score, score.neesPart(2))},
                          {"yaw", neesJson(score, score.neesPart(3))}}}};
  report["control"] = {{"position_rms_m", figure(score.hoverHorizontal())},
                       {"height_rms_m", figure(score.hoverHeight())},
                       {"yaw_rms_deg", figure(score.hoverYaw(), toDegrees(1.0))}};
  report["touchdown_m_s"] = run.last.has_truth ? json(run.last.verdict.hardest_touch) : json(nullptr);
  report["markers_m"] = json::array();
  for (const Eigen::Vector3d& ball : run.last.markers.all())
    report["markers_m"].push_back({ball.x(), ball.y(), ball.z()});
  report["cameras"] = json::array();
  json selected = json::object();
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    report["cameras"].push_back(cameraJson(run, rig.cameras[i], i));
    selected[rig.cameras[i].label] = 100.0 * score.selectedShare(cameraId(static_cast<int>(i)));
  }
  report["selected_features"] = selected;
  report["server_us"] = microseconds(run.last.server_p50, run.last.server_p99);
  report["frame_to_command_us"] = microseconds(run.last.frame_to_command_p50, run.last.frame_to_command_p99);
  report["transfer_us"] = microseconds(run.links.transfer().percentile(0.50), run.links.transfer().percentile(0.99));
  report["not_armed"] = checkReasons(score.unarmedBecause());
  report["failsafes"] = failsafeNames(score.failsafes());
  report["cameras_disagree"] = run.last.cameras_disagree;
  report["session"] = run.session.empty() ? json(nullptr) : json(run.session);
  return report.dump(2);
}

std::string flightText(const FlightRun& run, const RigConfig& rig) {
  const FlightScore& score = run.score;
  const double simulated_s = toSeconds(run.last.time);
  std::string text = line("%s after %.1f s (%.1f times real time)", outcome(run).c_str(), simulated_s,
                          simulated_s / run.wall_s);
  if (run.last.verdict.crashed)
    text += line(": %s at %.1f s", run.last.verdict.reason, run.last.verdict.crash_time_s);
  text += "\n";
  if (score.hoverHorizontal().count() > 0)
    text += line("  hover     %.1f mm horizontal, %.1f mm height, %.1f deg yaw (RMS to the set-point)\n",
                 1e3 * score.hoverHorizontal().value(), 1e3 * score.hoverHeight().value(),
                 toDegrees(score.hoverYaw().value()));
  if (score.trackedPosition().count() > 0)
    text += line("  tracking  %.2f mm, %.2f deg (RMS to the truth), pose lost for %.2f s\n",
                 1e3 * score.trackedPosition().value(), toDegrees(score.trackedOrientation().value()),
                 score.lostSeconds());
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    const CameraSnapshot& camera = run.last.cameras[i];
    text +=
        line("  camera %-3s %s, %llu frames, %llu dropped, %.0f %% of its markers used",
             rig.cameras[i].label.c_str(),
             camera.estimate.status == CameraStatus::kCalibrated ? "calibrated" : "not calibrated",
             static_cast<unsigned long long>(camera.frames), static_cast<unsigned long long>(camera.dropped),
             100.0 * score.selectedShare(cameraId(static_cast<int>(i))));
    if (camera.extraction_p99 > 0)
      text += line(", extraction %.0f us (99 %%: %.0f)", static_cast<double>(camera.extraction_p50) * 1e-3,
                   static_cast<double>(camera.extraction_p99) * 1e-3);
    text += "\n";
    if (camera.calibration_method != nullptr && camera.has_truth) {
      const CameraError error = cameraError(camera.estimate.camera_from_world, camera.true_camera_from_world);
      text += line("             by %s: %.1f mm and %.2f deg from its true place\n",
                   camera.calibration_method, 1e3 * error.position, toDegrees(error.orientation));
    }
  }
  text +=
      line("  server    %.0f us per command (99 %%: %.0f)\n", static_cast<double>(run.last.server_p50) * 1e-3,
           static_cast<double>(run.last.server_p99) * 1e-3);
  for (const auto& reason : checkReasons(score.unarmedBecause())) text += "  not armed: " + reason + "\n";
  for (const auto& name : failsafeNames(score.failsafes())) text += "  failsafe  " + name + "\n";
  return text;
}

}  // namespace helical
