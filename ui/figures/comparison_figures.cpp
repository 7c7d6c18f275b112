#include "ui/figures/comparison_figures.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>

#include "engine/geometry/rotation.h"
#include "engine/session/session_comparison.h"
#include "ui/figures/fitted_axis.h"
#include "ui/figures/session_figures.h"

namespace helical::figures {
namespace {

const QColor kColors[] = {kExperimentB, kExperimentA, QColor(0x2a, 0x8c, 0x4a), QColor(0x8a, 0x3f, 0xa0),
                          QColor(0xb0, 0x1e, 0x3c)};
constexpr Qt::PenStyle kStyles[] = {Qt::SolidLine, Qt::DashLine, Qt::DotLine};
const Stroke kDemanded{kInk, Qt::DashLine, kReferenceWidth};
constexpr double kWithoutLimit = 1e300;
constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

using Value = std::function<double(const SessionSample&)>;

/// The flights with their common time.
class Overlay {
 public:
  explicit Overlay(const std::vector<SessionSummary>& sessions)
      : sessions_(sessions), zeros_(commonZeros(sessions)) {
    for (std::size_t i = 0; i < sessions.size(); ++i) {
      begin_s_ = std::min(begin_s_, sessions[i].begin_s - zeros_[i]);
      end_s_ = std::max(end_s_, sessions[i].end_s - zeros_[i]);
    }
  }

  Curve curve(std::size_t session, const Stroke& stroke, const Value& value) const {
    Curve curve{stroke, {}};
    for (const SessionSample& sample : sessions_[session].samples) {
      const double y = value(sample);
      // No line belongs between -pi and pi.
      if (!curve.points.empty() && std::abs(y - curve.points.back().y()) > kPi && turns_)
        curve.points.emplace_back(sample.time_s - zeros_[session], kNotKnown);
      curve.points.emplace_back(sample.time_s - zeros_[session], y);
    }
    return curve;
  }

  /// A value of every flight, and the first one's reference where there is one.
  Panel panel(const QString& title, double smallest, double limit, const Value& value,
              const Value& reference = {}) const {
    std::vector<Curve> curves;
    if (reference) curves.push_back(curve(0, kDemanded, reference));
    for (std::size_t i = 0; i < sessions_.size(); ++i)
      curves.push_back(curve(i, comparisonStroke(i), value));
    return axes(title, smallest, limit, std::move(curves));
  }
  Panel angles(const QString& title, double smallest, const Value& value, const Value& reference) {
    turns_ = true;
    Panel result = panel(title, smallest, kWithoutLimit, value, reference);
    turns_ = false;
    return result;
  }

  std::vector<std::vector<LegendEntry>> keys(bool reference) const {
    std::vector<LegendEntry> row;
    if (reference)
      row.push_back({QStringLiteral("reference of A"), LegendKeyKind::kLine, kDemanded});
    for (std::size_t i = 0; i < sessions_.size(); ++i)
      row.push_back({comparisonName(sessions_, i), LegendKeyKind::kLine, comparisonStroke(i)});
    return {row};
  }

 private:
  Panel axes(const QString& title, double smallest, double limit, std::vector<Curve> curves) const {
    Panel result;
    const bool take_off = zeros_.front() == sessions_.front().rotors_on_s;
    result.x = fittedAxis(take_off ? QStringLiteral("time since the rotors began to turn [s]")
                                   : QStringLiteral("time [s]"),
                          begin_s_, end_s_, 0.0);
    result.y = fittedAxis(title, curves, smallest, limit);
    result.curves = std::move(curves);
    return result;
  }

  const std::vector<SessionSummary>& sessions_;
  std::vector<double> zeros_;
  double begin_s_ = std::numeric_limits<double>::infinity();
  double end_s_ = -std::numeric_limits<double>::infinity();
  bool turns_ = false;
};

/// Of a camera that a flight does not have nothing is known.
Value ofCamera(std::size_t camera, const std::function<double(const SessionSample::Camera&)>& value) {
  return [camera, value](const SessionSample& sample) {
    return camera < sample.cameras.size() ? value(sample.cameras[camera]) : kNotKnown;
  };
}

/// Cameras of the first flight whose pose some flight learnt.
std::vector<std::size_t> learningCameras(const std::vector<SessionSummary>& sessions) {
  std::vector<std::size_t> cameras;
  for (std::size_t c = 0; c < sessions.front().settings.rig.cameras.size(); ++c)
    if (std::any_of(sessions.begin(), sessions.end(), [c](const SessionSummary& session) {
          return c < session.methods.size() && !session.methods[c].empty();
        }))
      cameras.push_back(c);
  return cameras;
}

/// Lengths of the errors: three components of several flights would be a tangle.
Figure errorFigure(const std::vector<SessionSummary>& sessions, const Overlay& overlay, const char* stem,
                   const QString& title, const QString& unit, double smallest, double limit,
                   const std::function<double(const SessionSample::Camera&)>& value) {
  Figure figure{QString::fromLatin1(stem), title, overlay.keys(false), {}};
  for (const std::size_t camera : learningCameras(sessions)) {
    const QString name = QString::fromStdString(sessions.front().settings.rig.cameras[camera].name);
    figure.panels.push_back(overlay.panel(name + ' ' + unit, smallest, limit, ofCamera(camera, value)));
  }
  return figure;
}

/// fig08 of the first flight, fig11 of the second one.
void addFeatures(const std::vector<SessionSummary>& sessions, std::vector<Figure>& figures) {
  for (std::size_t i = 0; i < sessions.size(); ++i)
    for (Figure& figure : sessionFigures(sessions[i])) {
      if (figure.file_stem != QStringLiteral("fig08")) continue;
      if (i == 1) figure.file_stem = QStringLiteral("fig11");
      if (i > 1) figure.file_stem = QStringLiteral("features_%1").arg(QString::fromStdString(sessionLetter(i)));
      figure.title = QStringLiteral("Selected image features of %1").arg(comparisonName(sessions, i));
      figures.push_back(figure);
    }
}

bool hasData(const Figure& figure) {
  return std::any_of(figure.panels.begin(), figure.panels.end(), [](const Panel& panel) {
    return !panel.raster.runs.empty() ||
           std::any_of(panel.curves.begin(), panel.curves.end(), [](const Curve& curve) {
             return std::any_of(curve.points.begin(), curve.points.end(),
                                [](const QPointF& point) { return std::isfinite(point.y()); });
           });
  });
}

}  // namespace

Stroke comparisonStroke(std::size_t session) {
  return {kColors[session % std::size(kColors)], kStyles[session / std::size(kColors) % std::size(kStyles)],
          kCurveWidth};
}

QString comparisonName(const std::vector<SessionSummary>& sessions, std::size_t session) {
  constexpr int kLongest = 28;
  QString name = QString::fromStdString(std::filesystem::path(sessions[session].file).stem().string());
  if (name.size() > kLongest) name = name.left(kLongest - 1) + QChar(0x2026);
  return QString::fromStdString(sessionLetter(session)) + QStringLiteral(": ") + name;
}

std::vector<Figure> comparisonFigures(const std::vector<SessionSummary>& sessions) {
  Overlay overlay(sessions);
  const auto coordinate = [&](const QString& title, int axis) {
    return overlay.panel(
        title, 0.2, kWithoutLimit, [axis](const SessionSample& s) { return s.position(axis); },
        [axis](const SessionSample& s) { return s.reference(axis); });
  };
  const Panel yaw = overlay.angles(
      QStringLiteral("\u03b8 [rad]"), 0.2, [](const SessionSample& s) { return s.yaw; },
      [](const SessionSample& s) { return s.reference_yaw; });
  std::vector<Figure> figures{
      {QStringLiteral("fig06"), QStringLiteral("Time profile of the generalized coordinates x and y"),
       overlay.keys(true), {coordinate(QStringLiteral("x [m]"), 0), coordinate(QStringLiteral("y [m]"), 1)}},
      {QStringLiteral("fig07"), QStringLiteral("Time profile of the generalized coordinates z and \u03b8"),
       overlay.keys(true), {coordinate(QStringLiteral("z [m]"), 2), yaw}}};
  addFeatures(sessions, figures);
  figures.push_back(errorFigure(sessions, overlay, "fig09", QStringLiteral("Calibration error: position"),
                                QStringLiteral("[mm]"), 5.0, 100.0,
                                [](const auto& camera) { return 1e3 * camera.position_error.norm(); }));
  figures.push_back(errorFigure(sessions, overlay, "fig10", QStringLiteral("Calibration error: orientation"),
                                QStringLiteral("[\u00b0]"), 1.0, 10.0, [](const auto& camera) {
                                  return toDegrees(camera.rotation_error.norm());
                                }));
  figures.push_back({QStringLiteral("tracking"),
                     QStringLiteral("Error of the tracked pose"),
                     overlay.keys(false),
                     {overlay.panel(QStringLiteral("position [mm]"), 5.0, 100.0,
                                    [](const SessionSample& s) { return 1e3 * s.position_error; }),
                      overlay.panel(QStringLiteral("orientation [\u00b0]"), 1.0, 20.0, [](const SessionSample& s) {
                        return toDegrees(s.orientation_error);
                      })}});
  figures.push_back({QStringLiteral("latency"),
                     QStringLiteral("Latency, 99 % of the ticks so far"),
                     overlay.keys(false),
                     {overlay.panel(QStringLiteral("observation to command [ms]"), 1.0, 100.0,
                                    [](const SessionSample& s) { return s.server_p99_ms; }),
                      overlay.panel(QStringLiteral("frame to command [ms]"), 1.0, 100.0,
                                    [](const SessionSample& s) { return s.command_p99_ms; })}});
  std::erase_if(figures, [](const Figure& figure) { return !hasData(figure); });
  return figures;
}

}  // namespace helical::figures
