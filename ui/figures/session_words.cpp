#include "ui/figures/session_words.h"

#include <QStringList>
#include <cmath>
#include <filesystem>

#include "engine/geometry/rotation.h"
#include "engine/session/session_comparison.h"

namespace helical::figures {
namespace {

constexpr const char* kHead =
    "<html><head><style>"
    "h1 { font-size: 16pt; } h2 { font-size: 11pt; margin-top: 10pt; }"
    "th { text-align: left; }"
    "</style></head><body>";

QString escaped(const std::string& text) {
  return QString::fromStdString(text).toHtmlEscaped();
}

QString number(double value, int decimals, const char* unit) {
  if (!std::isfinite(value)) return QStringLiteral("\u2013");
  return QString::number(value, 'f', decimals) + QStringLiteral(" ") + QString::fromUtf8(unit);
}

/// Of a root mean square: a dash where nothing was measured.
QString measured(const RunningRms& rms, double scale, int decimals, const char* unit) {
  return rms.count() == 0 ? QStringLiteral("\u2013") : number(scale * rms.value(), decimals, unit);
}

class Table {
 public:
  explicit Table(const QString& title)
      : html_(QStringLiteral("<h2>") + title +
              QStringLiteral("</h2><table cellspacing=\"0\" cellpadding=\"3\">")) {}
  void row(const QStringList& cells, const char* tag = "td") {
    html_ += QStringLiteral("<tr>");
    for (const QString& cell : cells) html_ += QStringLiteral("<%1>%2</%1>").arg(QLatin1String(tag), cell);
    html_ += QStringLiteral("</tr>");
  }
  QString html() const { return html_ + QStringLiteral("</table>"); }

 private:
  QString html_;
};

QString outcome(const SessionSummary& session) {
  const Verdict& verdict = session.last.verdict;
  if (!session.last.has_truth)
    return session.last.phase == FlightPhase::kOff ? QStringLiteral("rotors off at its end")
                                                   : QStringLiteral("under way at its end");
  if (verdict.crashed)
    return QStringLiteral("crashed at %1 s: %2")
        .arg(verdict.crash_time_s, 0, 'f', 1)
        .arg(escaped(session.crash_reason));
  if (!verdict.has_flown) return QStringLiteral("never left the ground");
  return verdict.at_rest ? QStringLiteral("landed, at rest") : QStringLiteral("in the air at its end");
}

QString setUp(const SessionSummary& session) {
  const RigConfig& rig = session.settings.rig;
  Table table(QStringLiteral("Set-up"));
  table.row({QStringLiteral("session"),
             escaped(session.file) + (session.complete ? QString() : QStringLiteral(" (cut off)"))});
  table.row({QStringLiteral("rig"), escaped(rig.path)});
  table.row({QStringLiteral("flight plan"), escaped(session.settings.plan.name)});
  table.row({QStringLiteral("tracker, calibrator"), escaped(rig.tracker + ", " + rig.calibrator)});
  table.row({QStringLiteral("markers"), QString::number(rig.markers_in_body.count())});
  table.row({QStringLiteral("control rate"), number(rig.control.rate_hz, 0, "Hz")});
  return table.html();
}

QString conditions(const SessionSummary& session) {
  const SimulationOptions& simulation = session.settings.rig.simulation;
  Table table(QStringLiteral("Conditions"));
  table.row({QStringLiteral("time"),
             session.settings.realtime ? QStringLiteral("real") : QStringLiteral("simulated, in lock step")});
  table.row({QStringLiteral("length"), number(session.end_s - session.begin_s, 1, "s")});
  if (session.last.has_truth) {
    table.row({QStringLiteral("simulated field"),
               QStringLiteral("seed %1, gusts %2, parameters varied by %3 %, %4")
                   .arg(simulation.seed)
                   .arg(simulation.gust_factor, 0, 'g', 3)
                   .arg(100.0 * simulation.vary, 0, 'g', 3)
                   .arg(simulation.images ? QStringLiteral("rendered images")
                                          : QStringLiteral("simulated observations"))});
    for (const Occlusion& covered : simulation.occlusions)
      table.row(
          {QStringLiteral("covered"),
           escaped(session.settings.rig.cameras[static_cast<std::size_t>(covered.camera.index())].name) +
               QStringLiteral(", %1 to %2 s").arg(covered.from_s).arg(covered.to_s)});
    for (const Bump& bump : simulation.bumps)
      table.row({QStringLiteral("knocked"),
                 escaped(session.settings.rig.cameras[static_cast<std::size_t>(bump.camera.index())].name) +
                     QStringLiteral(" at %1 s by %2\u00b0, %3 mm")
                         .arg(bump.at_s)
                         .arg(toDegrees(bump.angle), 0, 'g', 3)
                         .arg(1e3 * bump.distance, 0, 'g', 3)});
  }
  return table.html();
}

QString errors(const SessionSummary& session) {
  const FlightScore& score = session.score;
  Table table(QStringLiteral("Outcome"));
  table.row({QStringLiteral("flight"), outcome(session)});
  table.row({QStringLiteral("without a pose, rotors turning"), number(score.lostSeconds(), 2, "s")});
  table.row({QStringLiteral("tracking error (RMS)"), measured(score.trackedPosition(), 1e3, 2, "mm"),
             measured(score.trackedOrientation(), toDegrees(1.0), 2, "\u00b0")});
  table.row({QStringLiteral("hover error (RMS)"), measured(score.hoverHorizontal(), 1e3, 1, "mm horizontal"),
             measured(score.hoverHeight(), 1e3, 1, "mm height"),
             measured(score.hoverYaw(), toDegrees(1.0), 2, "\u00b0 yaw")});
  table.row({QStringLiteral("observation to command"),
             number(1e-6 * static_cast<double>(session.last.server_p50), 3, "ms median"),
             number(1e-6 * static_cast<double>(session.last.server_p99), 3, "ms 99 %")});
  QStringList failsafes;
  for (std::uint32_t bit = 1; bit != 0; bit <<= 1)
    if ((score.failsafes() & bit) != 0)
      failsafes << QString::fromLatin1(toString(static_cast<Failsafe>(bit)));
  table.row({QStringLiteral("failsafes"),
             failsafes.isEmpty() ? QStringLiteral("none") : failsafes.join(QStringLiteral(", "))});
  return table.html();
}

const char* statusWord(CameraStatus status) {
  switch (status) {
    case CameraStatus::kUncalibrated:
      return "no pose";
    case CameraStatus::kCalibrating:
      return "calibrating";
    case CameraStatus::kCalibrated:
      return "in use";
    case CameraStatus::kRejected:
      return "rejected";
  }
  return "";
}

QString cameras(const SessionSummary& session) {
  Table table(QStringLiteral("Cameras at the end"));
  table.row(
      {QStringLiteral("camera"), QStringLiteral("status"), QStringLiteral("pose by"),
       QStringLiteral("frames"), QStringLiteral("dropped"), QStringLiteral("error"), QStringLiteral("sigma"),
       QStringLiteral("bound"), QStringLiteral("1 cm after"), QStringLiteral("knocks found")},
      "th");
  for (std::size_t c = 0; c < session.settings.rig.cameras.size(); ++c) {
    const CameraSnapshot& camera = session.last.cameras[c];
    const SessionSample::Camera& end = session.samples.back().cameras[c];
    const bool learnt = !session.methods[c].empty();
    const double converged_s = session.score.convergedAfter(cameraId(static_cast<int>(c)));
    table.row({escaped(session.settings.rig.cameras[c].name), QString::fromLatin1(statusWord(end.status)),
               learnt ? escaped(session.methods[c]) : QStringLiteral("rig file"),
               QString::number(camera.frames), QString::number(camera.dropped),
               number(1e3 * end.position_error.norm(), 1, "mm"), number(1e3 * end.position_sigma, 1, "mm"),
               number(1e3 * end.position_bound, 1, "mm"),
               learnt && converged_s >= 0.0 ? number(converged_s, 1, "s") : QStringLiteral("\u2013"),
               QString::number(camera.knocks_found)});
  }
  return table.html();
}

QString events(const SessionSummary& session) {
  Table table(QStringLiteral("Events"));
  for (const EngineEvent& event : session.events)
    table.row({number(toSeconds(event.time), 2, "s"), QString::fromUtf8(event.text.data()).toHtmlEscaped()});
  return table.html();
}

}  // namespace

QString sessionInWords(const SessionSummary& session) {
  const std::string name = std::filesystem::path(session.file).stem().string();
  return QString::fromLatin1(kHead) + QStringLiteral("<h1>Flight report: ") + escaped(name) +
         QStringLiteral("</h1>") + setUp(session) + conditions(session) + errors(session) + cameras(session) +
         events(session) + QStringLiteral("</body></html>");
}

QString comparisonInWords(const std::vector<SessionSummary>& sessions) {
  Table files(QStringLiteral("Flights"));
  for (std::size_t i = 0; i < sessions.size(); ++i)
    files.row({escaped(sessionLetter(i)), escaped(sessions[i].file) +
                                              (sessions[i].complete ? QString() : QStringLiteral(" (cut off)"))});
  Table table(QStringLiteral("Side by side"));
  QStringList head{QString()};
  for (std::size_t i = 0; i < sessions.size(); ++i) head << QString::fromStdString(sessionLetter(i));
  table.row(head, "th");
  for (const ComparisonRow& row : compareSessions(sessions)) {
    QStringList cells{escaped(row.unit.empty() ? row.name : row.name + " [" + row.unit + "]")};
    for (const double value : row.values) cells << number(value, row.decimals, "");
    for (const auto& word : row.words) cells << escaped(word);
    table.row(cells);
  }
  return QString::fromLatin1(kHead) + QStringLiteral("<h1>Comparison of flights</h1>") + files.html() +
         table.html() + QStringLiteral("</body></html>");
}

}  // namespace helical::figures
