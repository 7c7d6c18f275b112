#include "ui/figures/paper_figures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <system_error>

#include "engine/base/check.h"
#include "engine/base/error.h"
#include "engine/geometry/rotation.h"
#include "ui/figures/clipped_curve.h"
#include "ui/figures/figure_file.h"
#include "ui/figures/offscreen_application.h"

namespace helical::figures {
namespace {

constexpr double kLastSecond = 25.0;
constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

const Stroke kReference{kInk, Qt::DashLine, kReferenceWidth};
const Stroke kStrokeA{kExperimentA, Qt::SolidLine, kCurveWidth};
const Stroke kStrokeB{kExperimentB, Qt::SolidLine, kCurveWidth};
const Qt::PenStyle kComponentStyles[3] = {Qt::SolidLine, Qt::DashLine, Qt::DotLine};

struct Flights {
  const FlightTrace& a;
  const FlightTrace& b;
};

PlotAxis timeAxis() {
  return plotAxis(QStringLiteral("time [s]"), 0.0, kLastSecond, 5.0);
}

/// One value of every sample against time.
template <typename Value>
std::vector<QPointF> profile(const FlightTrace& trace, const Value& value) {
  std::vector<QPointF> points;
  points.reserve(trace.samples.size());
  for (const TraceSample& sample : trace.samples) points.emplace_back(sample.time_s, value(sample));
  return points;
}

/// Breaks the curve of an angle where it goes round: no line belongs between -pi and pi.
std::vector<QPointF> breakTurns(const std::vector<QPointF>& points, double half_turn) {
  std::vector<QPointF> broken;
  for (const QPointF& point : points) {
    if (!broken.empty() && std::abs(point.y() - broken.back().y()) > half_turn)
      broken.emplace_back(point.x(), kNotANumber);
    broken.push_back(point);
  }
  return broken;
}

/// Of two flights of one plan the longer shows the reference of both; should they differ, both are shown.
void addReferences(Panel& panel, std::vector<QPointF> longer, std::vector<QPointF> shorter) {
  if (longer.size() < shorter.size()) std::swap(longer, shorter);
  if (!std::equal(shorter.begin(), shorter.end(), longer.begin()))
    panel.curves.push_back({kReference, shorter});
  panel.curves.push_back({kReference, longer});
}

/// From where it was covered to the landing.
void addSpan(Panel& panel, const FlightTrace& trace) {
  if (trace.covered_camera < 0 || trace.samples.empty()) return;
  const QString text = QStringLiteral("camera %1 covered").arg(trace.covered_camera + 1);
  const double landing = trace.samples.back().time_s;
  if (landing <= trace.covered_from_s || trace.covered_from_s >= kLastSecond) return;
  for (ShadedSpan& span : panel.spans) {
    if (span.text == text && span.from_s == trace.covered_from_s) {
      span.to_s = std::max(span.to_s, landing);
      return;
    }
  }
  panel.spans.push_back({text, trace.covered_from_s, landing});
}

void addCrash(Panel& panel, const FlightTrace& trace, const QString& who, const QColor& color) {
  if (!trace.crashed) return;
  QString text = who + QStringLiteral(" crashed");
  if (trace.crashed_at_s > kLastSecond) text += QStringLiteral(" at %1 s").arg(trace.crashed_at_s, 0, 'f', 1);
  panel.notes.push_back({text, color, trace.crashed_at_s});
}

Panel curvesPanel(const Flights& flights, const PlotAxis& values) {
  Panel panel;
  panel.x = timeAxis();
  panel.y = values;
  addSpan(panel, flights.a);
  addSpan(panel, flights.b);
  addCrash(panel, flights.a, QString::fromStdString(flights.a.name), kExperimentA);
  addCrash(panel, flights.b, QString::fromStdString(flights.b.name), kExperimentB);
  std::sort(panel.notes.begin(), panel.notes.end(),
            [](const TimeNote& one, const TimeNote& other) { return one.at_s > other.at_s; });
  return panel;
}

/// A generalized coordinate of both flights and its reference.
template <typename Value, typename Reference>
Panel coordinatePanel(const Flights& flights, const PlotAxis& values, const Value& value,
                      const Reference& reference) {
  Panel panel = curvesPanel(flights, values);
  addReferences(panel, profile(flights.b, reference), profile(flights.a, reference));
  panel.curves.push_back({kStrokeA, breakTurns(profile(flights.a, value), kPi)});
  panel.curves.push_back({kStrokeB, breakTurns(profile(flights.b, value), kPi)});
  return panel;
}

/// The three components of an error of both flights; `half_turn` is infinite for lengths.
template <typename Error>
Panel errorPanel(const Flights& flights, const PlotAxis& values, double half_turn, const Error& error) {
  Panel panel = curvesPanel(flights, values);
  const Stroke zero{kInk, Qt::SolidLine, kReferenceWidth};
  panel.curves.push_back({zero, {{0.0, 0.0}, {kLastSecond, 0.0}}});
  const auto add = [&](const FlightTrace& trace, const QColor& color) {
    for (int i = 0; i < 3; ++i) {
      const auto component = profile(trace, [&](const TraceSample& sample) { return error(sample)(i); });
      panel.curves.push_back({{color, kComponentStyles[i], kErrorWidth}, breakTurns(component, half_turn)});
    }
  };
  add(flights.a, kExperimentA);
  add(flights.b, kExperimentB);
  return panel;
}

bool leavesAxes(const Panel& panel) {
  const PlotAxes axes(QRectF(0.0, 0.0, kFigureWidth, panel.height_mm), panel.x, panel.y);
  const auto leaves = [&](const Curve& curve) { return !clipCurve(axes, curve.points).exits.empty(); };
  const auto ends_late = [&](const LabelRun& run) { return run.to_s > panel.x.high + panel.x.slack(); };
  return std::any_of(panel.curves.begin(), panel.curves.end(), leaves) ||
         std::any_of(panel.raster.runs.begin(), panel.raster.runs.end(), ends_late);
}

/// Says what the triangles mean where there are any.
void addBeyondAxis(Figure& figure) {
  if (!std::any_of(figure.panels.begin(), figure.panels.end(), leavesAxes)) return;
  if (figure.legend.empty()) figure.legend.emplace_back();
  figure.legend.back().push_back(
      {QStringLiteral("beyond the axis"), LegendKeyKind::kBeyondAxis, Stroke{kQuietInk}});
}

std::vector<LegendEntry> flightKeys(const Flights& flights, const Stroke& reference) {
  return {{QStringLiteral("reference"), LegendKeyKind::kLine, reference},
          {QString::fromStdString(flights.a.name), LegendKeyKind::kLine, kStrokeA},
          {QString::fromStdString(flights.b.name), LegendKeyKind::kLine, kStrokeB}};
}

std::vector<LegendEntry> componentKeys() {
  std::vector<LegendEntry> keys{{QStringLiteral("components:"), LegendKeyKind::kNone, {}}};
  const char* const names[3] = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i)
    keys.push_back(
        {QString::fromLatin1(names[i]), LegendKeyKind::kLine, {kQuietInk, kComponentStyles[i], kErrorWidth}});
  return keys;
}

Figure figure(int number, const QString& title, std::vector<std::vector<LegendEntry>> legend,
              std::vector<Panel> panels) {
  Figure figure{QStringLiteral("fig%1").arg(number, 2, 10, QChar('0')), title, std::move(legend),
                std::move(panels)};
  addBeyondAxis(figure);
  return figure;
}

Figure horizontalFigure(const Flights& flights) {
  const auto panel = [&](const QString& title, int i) {
    return coordinatePanel(
        flights, plotAxis(title, -0.8, 0.2, 0.2), [i](const TraceSample& s) { return s.position(i); },
        [i](const TraceSample& s) { return s.reference(i); });
  };
  return figure(6, QStringLiteral("Time profile of the generalized coordinates x and y"),
                {flightKeys(flights, kReference)},
                {panel(QStringLiteral("x [m]"), 0), panel(QStringLiteral("y [m]"), 1)});
}

Figure heightAndYawFigure(const Flights& flights) {
  const Panel height = coordinatePanel(
      flights, plotAxis(QStringLiteral("z [m]"), 0.0, 0.8, 0.1),
      [](const TraceSample& s) { return s.position.z(); },
      [](const TraceSample& s) { return s.reference.z(); });
  const Panel yaw = coordinatePanel(
      flights, plotAxis(QStringLiteral("\u03b8 [rad]"), -0.4, 0.4, 0.2),
      [](const TraceSample& s) { return s.yaw; }, [](const TraceSample& s) { return s.reference_yaw; });
  return figure(7, QStringLiteral("Time profile of the generalized coordinates z and \u03b8"),
                {flightKeys(flights, kReference)}, {height, yaw});
}

Figure positionErrorFigure(const Flights& flights) {
  const Panel panel = errorPanel(flights, plotAxis(QStringLiteral("error of position [m]"), -0.8, 0.8, 0.2),
                                 std::numeric_limits<double>::infinity(),
                                 [](const TraceSample& s) { return s.camera_position_error; });
  return figure(9, QStringLiteral("Calibration error: position"),
                {flightKeys(flights, Stroke{kInk, Qt::SolidLine, kReferenceWidth}), componentKeys()},
                {panel});
}

Figure orientationErrorFigure(const Flights& flights) {
  const Panel panel = errorPanel(
      flights, plotAxis(QStringLiteral("error of orientation [\u00b0]"), -40.0, 40.0, 10.0), 180.0,
      [](const TraceSample& s) -> Eigen::Vector3d { return toDegrees(1.0) * s.camera_rotation_error; });
  return figure(10, QStringLiteral("Calibration error: orientation"),
                {flightKeys(flights, Stroke{kInk, Qt::SolidLine, kReferenceWidth}), componentKeys()},
                {panel});
}

/// The paper's axis for its three cameras of four markers: 0 to 12 in steps of 2. Half a row below, for the
/// bar of label 0.
PlotAxis labelAxis(int labels) {
  constexpr int kMostTicks = 8;
  int step = 1;
  for (int decade = 1; labels > kMostTicks * step; decade *= 10) {
    for (const int factor : {1, 2, 5}) {
      step = factor * decade;
      if (labels <= kMostTicks * step) break;
    }
  }
  return PlotAxis{QStringLiteral("label of the image features"), -0.5, static_cast<double>(labels),
                  static_cast<double>(step), 0.0};
}

Figure rasterFigure(int number, const FlightTrace& trace, const QColor& color) {
  HELICAL_CHECK(trace.camera_count > 0 && trace.camera_count <= kMaxCameras);
  HELICAL_CHECK(trace.marker_count > 0 && trace.marker_count <= kMaxMarkers);
  Panel panel;
  panel.x = timeAxis();
  panel.y = labelAxis(trace.camera_count * trace.marker_count);
  panel.height_mm = std::max(kRasterHeight, kRasterHeightPerCamera * trace.camera_count);
  panel.raster = {color, labelRuns(trace)};
  addSpan(panel, trace);
  addCrash(panel, trace, QStringLiteral("the helicopter"), kInk);
  constexpr double kHalfRow = 0.3;
  for (int camera = 0; camera < trace.camera_count; ++camera) {
    const int first = camera * trace.marker_count;
    panel.braces.push_back({QStringLiteral("camera %1").arg(camera + 1), first - kHalfRow,
                            first + trace.marker_count - 1 + kHalfRow});
  }
  return figure(
      number,
      QStringLiteral("The label of the selected image features, %1").arg(QString::fromStdString(trace.name)),
      {}, {panel});
}

}  // namespace

std::vector<Figure> paperFigures(const FlightTrace& experiment_a, const FlightTrace& experiment_b) {
  const Flights flights{experiment_a, experiment_b};
  return {horizontalFigure(flights),
          heightAndYawFigure(flights),
          rasterFigure(8, experiment_a, kExperimentA),
          positionErrorFigure(flights),
          orientationErrorFigure(flights),
          rasterFigure(11, experiment_b, kExperimentB)};
}

}  // namespace helical::figures

namespace helical {

std::vector<std::filesystem::path> writePaperFigures(const FlightTrace& experiment_a,
                                                     const FlightTrace& experiment_b,
                                                     const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw Error(ErrorKind::kSystem, "the folder for the figures cannot be made: " + error.message(),
                folder.string(), "name a folder that you may write to");
  const figures::OffscreenApplication application;
  std::vector<std::filesystem::path> files;
  for (const figures::Figure& figure : figures::paperFigures(experiment_a, experiment_b)) {
    for (auto& file : figures::writeFigure(figure, folder)) files.push_back(std::move(file));
  }
  return files;
}

}  // namespace helical
