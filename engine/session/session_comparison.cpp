#include "engine/session/session_comparison.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "engine/geometry/rotation.h"

namespace helical {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

double measured(const RunningRms& rms, double scale) {
  return rms.count() > 0 ? scale * rms.value() : kUnknown;
}

double latencyUs(TimeNs time) {
  return time > 0 ? 1e-3 * static_cast<double>(time) : kUnknown;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : ", ") + word;
  return text.empty() ? "none" : text;
}

/// Collects rows over the flights.
class Rows {
 public:
  explicit Rows(const std::vector<SessionSummary>& sessions) : sessions_(sessions) {}

  void words(const char* key, const char* name, const std::function<std::string(const SessionSummary&)>& word) {
    ComparisonRow& row = add(key, name, "", 0);
    for (const auto& session : sessions_) row.words.push_back(word(session));
  }
  void values(const std::string& key, const std::string& name, const char* unit, int decimals,
              const std::function<double(const SessionSummary&)>& value) {
    ComparisonRow& row = add(key, name, unit, decimals);
    for (const auto& session : sessions_) row.values.push_back(value(session));
  }
  std::vector<ComparisonRow> take() { return std::move(rows_); }

 private:
  ComparisonRow& add(const std::string& key, const std::string& name, const char* unit, int decimals) {
    return rows_.emplace_back(ComparisonRow{key, name, unit, decimals, {}, {}});
  }
  const std::vector<SessionSummary>& sessions_;
  std::vector<ComparisonRow> rows_;
};

/// Negative: this flight has no such camera.
int cameraOf(const SessionSummary& session, const std::string& label) {
  const auto& cameras = session.settings.rig.cameras;
  const auto found = std::find_if(cameras.begin(), cameras.end(),
                                  [&](const CameraConfig& camera) { return camera.label == label; });
  return found == cameras.end() ? -1 : static_cast<int>(found - cameras.begin());
}

std::vector<std::string> labelsOf(const std::vector<SessionSummary>& sessions) {
  std::vector<std::string> labels;
  for (const auto& session : sessions)
    for (const auto& camera : session.settings.rig.cameras)
      if (std::find(labels.begin(), labels.end(), camera.label) == labels.end()) labels.push_back(camera.label);
  return labels;
}

using OfCamera = std::function<double(const SessionSummary&, std::size_t)>;

void addCamera(Rows& rows, const std::string& label) {
  const auto add = [&](const char* key, const char* name, const char* unit, int decimals, const OfCamera& value) {
    rows.values("camera_" + label + "_" + key, "camera " + label + ": " + name, unit, decimals,
                [&](const SessionSummary& session) {
                  const int camera = cameraOf(session, label);
                  return camera < 0 ? kUnknown : value(session, static_cast<std::size_t>(camera));
                });
  };
  const auto end = [](const SessionSummary& s, std::size_t c) { return s.samples.back().cameras[c]; };
  add("frames_dropped", "frames dropped", "", 0, [](const SessionSummary& s, std::size_t c) {
    return static_cast<double>(s.last.cameras[c].dropped);
  });
  add("markers_used_percent", "markers used", "%", 0, [](const SessionSummary& s, std::size_t c) {
    return 100.0 * s.score.selectedShare(cameraId(static_cast<int>(c)));
  });
  add("position_error_mm", "position error at the end", "mm", 1,
      [&](const SessionSummary& s, std::size_t c) { return 1e3 * end(s, c).position_error.norm(); });
  add("orientation_error_deg", "orientation error at the end", "deg", 2,
      [&](const SessionSummary& s, std::size_t c) { return toDegrees(end(s, c).rotation_error.norm()); });
  add("position_sigma_mm", "position sigma at the end", "mm", 1,
      [&](const SessionSummary& s, std::size_t c) { return 1e3 * end(s, c).position_sigma; });
  add("one_cm_after_s", "within 1 cm and 0.5 deg after", "s", 1, [](const SessionSummary& s, std::size_t c) {
    const double after = s.score.convergedAfter(cameraId(static_cast<int>(c)));
    return after >= 0.0 && !s.methods[c].empty() ? after : kUnknown;
  });
  add("knocks_found", "knocks found", "", 0, [](const SessionSummary& s, std::size_t c) {
    return static_cast<double>(s.last.cameras[c].knocks_found);
  });
}

void addSetUp(Rows& rows) {
  rows.words("outcome", "outcome", [](const SessionSummary& s) { return outcomeOf(s.last, s.score); });
  rows.words("plan", "flight plan", [](const SessionSummary& s) { return s.settings.plan.name; });
  rows.words("tracker", "tracker", [](const SessionSummary& s) { return s.settings.rig.tracker; });
  rows.words("calibrator", "calibrator", [](const SessionSummary& s) { return s.settings.rig.calibrator; });
  rows.words("failsafes", "failsafes",
             [](const SessionSummary& s) { return joined(failsafeNames(s.score.failsafes())); });
}

void addFlight(Rows& rows) {
  rows.values("length_s", "length", "s", 1, [](const SessionSummary& s) { return s.end_s - s.begin_s; });
  rows.values("lost_s", "without a pose, rotors turning", "s", 2,
              [](const SessionSummary& s) { return s.score.lostSeconds(); });
  rows.values("tracking_mm", "tracking error (RMS)", "mm", 2,
              [](const SessionSummary& s) { return measured(s.score.trackedPosition(), 1e3); });
  rows.values("tracking_deg", "tracking error (RMS)", "deg", 2,
              [](const SessionSummary& s) { return measured(s.score.trackedOrientation(), toDegrees(1.0)); });
  rows.values("hover_horizontal_mm", "hover error, horizontal (RMS)", "mm", 1,
              [](const SessionSummary& s) { return measured(s.score.hoverHorizontal(), 1e3); });
  rows.values("hover_height_mm", "hover error, height (RMS)", "mm", 1,
              [](const SessionSummary& s) { return measured(s.score.hoverHeight(), 1e3); });
  rows.values("hover_yaw_deg", "hover error, yaw (RMS)", "deg", 2,
              [](const SessionSummary& s) { return measured(s.score.hoverYaw(), toDegrees(1.0)); });
  rows.values("server_p50_us", "observation to command, median", "us", 0,
              [](const SessionSummary& s) { return latencyUs(s.last.server_p50); });
  rows.values("server_p99_us", "observation to command, 99 %", "us", 0,
              [](const SessionSummary& s) { return latencyUs(s.last.server_p99); });
  rows.values("frame_to_command_p99_us", "frame to command, 99 %", "us", 0,
              [](const SessionSummary& s) { return latencyUs(s.last.frame_to_command_p99); });
}

}  // namespace

std::vector<ComparisonRow> compareSessions(const std::vector<SessionSummary>& sessions) {
  Rows rows(sessions);
  addSetUp(rows);
  addFlight(rows);
  for (const auto& label : labelsOf(sessions)) addCamera(rows, label);
  return rows.take();
}

std::vector<double> commonZeros(const std::vector<SessionSummary>& sessions) {
  const bool all_flew = std::all_of(sessions.begin(), sessions.end(),
                                    [](const SessionSummary& s) { return std::isfinite(s.rotors_on_s); });
  std::vector<double> zeros;
  for (const auto& session : sessions) zeros.push_back(all_flew ? session.rotors_on_s : session.begin_s);
  return zeros;
}

std::string sessionLetter(std::size_t index) {
  std::string letters(1, static_cast<char>('A' + index % 26));
  return index < 26 ? letters : sessionLetter(index / 26 - 1) + letters;
}

}  // namespace helical
