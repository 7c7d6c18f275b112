#include "ui/figures/session_figures.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "engine/geometry/rotation.h"
#include "ui/figures/fitted_axis.h"
#include "ui/figures/label_runs.h"

namespace helical::figures {
namespace {

using Camera = SessionSample::Camera;

const QColor kGreen{0x2a, 0x8c, 0x4a};
const QColor kPurple{0x8a, 0x3f, 0xa0};
const Stroke kTracked{kExperimentB, Qt::SolidLine, kCurveWidth};
const Stroke kTrue{kExperimentA, Qt::SolidLine, kCurveWidth};
const Stroke kDemanded{kInk, Qt::DashLine, kReferenceWidth};
const Stroke kBound{kQuietInk, Qt::DotLine, kCurveWidth};
const Stroke kComponents[3] = {{kExperimentB, Qt::SolidLine, kErrorWidth},
                               {kExperimentA, Qt::SolidLine, kErrorWidth},
                               {kGreen, Qt::SolidLine, kErrorWidth}};
constexpr double kWithoutLimit = 1e300;

QString cameraName(const SessionSummary& session, std::size_t camera) {
  return QString::fromStdString(session.settings.rig.cameras[camera].name);
}

template <typename Value>
Curve curve(const SessionSummary& session, const Stroke& stroke, const Value& value) {
  Curve curve{stroke, {}};
  curve.points.reserve(session.samples.size());
  for (const SessionSample& sample : session.samples) curve.points.emplace_back(sample.time_s, value(sample));
  return curve;
}

/// No line belongs between -pi and pi.
Curve withoutTurns(const Curve& angle) {
  Curve broken{angle.stroke, {}};
  for (const QPointF& point : angle.points) {
    if (!broken.points.empty() && std::abs(point.y() - broken.points.back().y()) > kPi)
      broken.points.emplace_back(point.x(), std::nan(""));
    broken.points.push_back(point);
  }
  return broken;
}

/// Values beyond `limit` leave the frame: the first guess of a camera would flatten all that follows.
Panel panel(const SessionSummary& session, const QString& title, double smallest, double limit,
            std::vector<Curve> curves) {
  Panel result;
  result.x = fittedAxis(QStringLiteral("time [s]"), session.begin_s, session.end_s, 0.0);
  result.y = fittedAxis(title, curves, smallest, limit);
  result.curves = std::move(curves);
  for (const EngineEvent& event : session.events)
    if (event.severity == Severity::kDanger && result.notes.empty())
      result.notes.push_back({QString::fromUtf8(event.text.data()), kInk, toSeconds(event.time)});
  return result;
}

bool hasData(const Figure& figure) {
  return std::any_of(figure.panels.begin(), figure.panels.end(), [](const Panel& one) {
    return !one.raster.runs.empty() ||
           std::any_of(one.curves.begin(), one.curves.end(), [](const Curve& line) {
             return std::any_of(line.points.begin(), line.points.end(),
                                [](const QPointF& point) { return std::isfinite(point.y()); });
           });
  });
}

template <typename Tracked, typename True, typename Demanded>
Panel coordinate(const SessionSummary& session, const QString& title, const Tracked& tracked,
                 const True& truth, const Demanded& demanded) {
  return panel(session, title, 0.2, kWithoutLimit,
               {withoutTurns(curve(session, kTrue, truth)), withoutTurns(curve(session, kTracked, tracked)),
                curve(session, kDemanded, demanded)});
}

Panel coordinate(const SessionSummary& session, const QString& title, int axis) {
  return coordinate(
      session, title, [axis](const SessionSample& s) { return s.position(axis); },
      [axis](const SessionSample& s) { return s.truth(axis); },
      [axis](const SessionSample& s) { return s.reference(axis); });
}

std::vector<std::vector<LegendEntry>> coordinateKeys() {
  return {{{QStringLiteral("reference"), LegendKeyKind::kLine, kDemanded},
           {QStringLiteral("tracked"), LegendKeyKind::kLine, kTracked},
           {QStringLiteral("true"), LegendKeyKind::kLine, kTrue}}};
}

Figure featuresFigure(const SessionSummary& session) {
  FlightTrace trace;
  trace.camera_count = static_cast<int>(session.settings.rig.cameras.size());
  trace.marker_count = session.settings.rig.markers_in_body.count();
  for (const SessionSample& sample : session.samples) {
    TraceSample& added = trace.samples.emplace_back();
    added.time_s = sample.time_s;
    for (std::size_t c = 0; c < sample.cameras.size(); ++c) added.selected[c] = sample.cameras[c].selected;
  }
  Panel raster = panel(session, {}, 1.0, kWithoutLimit, {});
  const int labels = trace.camera_count * trace.marker_count;
  raster.y = fittedAxis(QStringLiteral("label of the image features"), 0.0, labels, 1.0);
  raster.y.low = -0.5;
  raster.y.high = labels;
  raster.height_mm = std::max(kRasterHeight, kRasterHeightPerCamera * trace.camera_count);
  raster.raster = {kExperimentB, labelRuns(trace)};
  constexpr double kHalfRow = 0.3;
  for (int camera = 0; camera < trace.camera_count; ++camera) {
    const int first = camera * trace.marker_count;
    raster.braces.push_back({cameraName(session, static_cast<std::size_t>(camera)), first - kHalfRow,
                             first + trace.marker_count - 1 + kHalfRow});
  }
  return {QStringLiteral("fig08"), QStringLiteral("The label of the selected image features"), {}, {raster}};
}

/// The longest time without interruption for which a camera was covered.
std::optional<ShadedSpan> longestCover(const SessionSummary& session, std::size_t camera) {
  std::optional<ShadedSpan> longest;
  double since_s = 0.0;
  bool was_covered = false;
  for (const SessionSample& sample : session.samples) {
    const bool covered = sample.cameras[camera].covered;
    if (covered && !was_covered) since_s = sample.time_s;
    was_covered = covered;
    if (covered && (!longest || sample.time_s - since_s > longest->to_s - longest->from_s))
      longest = {cameraName(session, camera) + QStringLiteral(" is covered"), since_s, sample.time_s};
  }
  return longest;
}

/// Of flights in which a camera was covered, as in the paper's experiment B. No panels for any other one.
Figure coveredFeaturesFigure(const SessionSummary& session) {
  Figure figure = featuresFigure(session);
  figure.file_stem = QStringLiteral("fig11");
  figure.title = QStringLiteral("The label of the selected image features, with covered cameras");
  for (std::size_t c = 0; c < session.settings.rig.cameras.size(); ++c)
    if (const auto span = longestCover(session, c)) figure.panels[0].spans.push_back(*span);
  if (figure.panels[0].spans.empty()) figure.panels.clear();
  return figure;
}

/// One panel for each camera whose pose is learnt.
template <typename Value>
Figure errorFigure(const SessionSummary& session, const char* stem, const QString& title, const QString& unit,
                   double smallest, double limit, const Value& value) {
  Figure figure{QString::fromLatin1(stem),
                title,
                {{{QStringLiteral("x"), LegendKeyKind::kLine, kComponents[0]},
                  {QStringLiteral("y"), LegendKeyKind::kLine, kComponents[1]},
                  {QStringLiteral("z"), LegendKeyKind::kLine, kComponents[2]}}},
                {}};
  for (std::size_t c = 0; c < session.settings.rig.cameras.size(); ++c) {
    if (session.methods[c].empty()) continue;
    std::vector<Curve> curves;
    for (int axis = 0; axis < 3; ++axis)
      curves.push_back(curve(session, kComponents[axis],
                             [&](const SessionSample& sample) { return value(sample.cameras[c])(axis); }));
    figure.panels.push_back(panel(session, cameraName(session, c) + QStringLiteral(" ") + unit, smallest,
                                  limit, std::move(curves)));
  }
  return figure;
}

Figure convergenceFigure(const SessionSummary& session) {
  Figure figure{QStringLiteral("calibration"),
                QStringLiteral("Calibration: position error, sigma and Cramer-Rao bound"),
                {{{QStringLiteral("error"), LegendKeyKind::kLine, kTrue},
                  {QStringLiteral("sigma"), LegendKeyKind::kLine, kTracked},
                  {QStringLiteral("bound"), LegendKeyKind::kLine, kBound}}},
                {}};
  for (std::size_t c = 0; c < session.settings.rig.cameras.size(); ++c) {
    if (session.methods[c].empty()) continue;
    const auto millimetres = [&](const Stroke& stroke, const auto& value) {
      return curve(session, stroke, [&](const SessionSample& s) { return 1e3 * value(s.cameras[c]); });
    };
    figure.panels.push_back(
        panel(session, cameraName(session, c) + QStringLiteral(" [mm]"), 5.0, 50.0,
              {millimetres(kTrue, [](const Camera& camera) { return camera.position_error.norm(); }),
               millimetres(kTracked, [](const Camera& camera) { return camera.position_sigma; }),
               millimetres(kBound, [](const Camera& camera) { return camera.position_bound; })}));
  }
  return figure;
}

const Stroke& cameraStroke(std::size_t camera) {
  static const Stroke kStrokes[] = {Stroke{kExperimentB}, Stroke{kExperimentA}, Stroke{kGreen}, Stroke{kPurple},
                                    Stroke{kExperimentB, Qt::DashLine}, Stroke{kExperimentA, Qt::DashLine},
                                    Stroke{kGreen, Qt::DashLine}, Stroke{kPurple, Qt::DashLine}};
  return kStrokes[camera % std::size(kStrokes)];
}

std::vector<std::vector<LegendEntry>> cameraKeys(const SessionSummary& session) {
  std::vector<LegendEntry> keys;
  for (std::size_t c = 0; c < session.settings.rig.cameras.size(); ++c)
    keys.push_back({cameraName(session, c), LegendKeyKind::kLine, cameraStroke(c)});
  return {keys};
}

/// One value of every camera in one panel.
template <typename Value>
Figure camerasFigure(const SessionSummary& session, const char* stem, const QString& title, const QString& unit,
                     double smallest, double limit, const Value& value) {
  std::vector<Curve> curves;
  for (std::size_t c = 0; c < session.settings.rig.cameras.size(); ++c)
    curves.push_back(
        curve(session, cameraStroke(c), [&](const SessionSample& sample) { return value(sample.cameras[c]); }));
  return {QString::fromLatin1(stem), title, cameraKeys(session),
          {panel(session, unit, smallest, limit, std::move(curves))}};
}

Figure orientationFigure(const SessionSummary& session) {
  Figure figure{QStringLiteral("calibration_orientation"),
                QStringLiteral("Calibration: orientation error and sigma"),
                {{{QStringLiteral("error"), LegendKeyKind::kLine, kTrue},
                  {QStringLiteral("sigma"), LegendKeyKind::kLine, kTracked}}},
                {}};
  for (std::size_t c = 0; c < session.settings.rig.cameras.size(); ++c) {
    if (session.methods[c].empty()) continue;
    figure.panels.push_back(panel(
        session, cameraName(session, c) + QStringLiteral(" [\u00b0]"), 0.5, 5.0,
        {curve(session, kTrue,
               [c](const SessionSample& s) { return toDegrees(s.cameras[c].rotation_error.norm()); }),
         curve(session, kTracked,
               [c](const SessionSample& s) { return toDegrees(s.cameras[c].orientation_sigma); })}));
  }
  return figure;
}

/// How often a camera's frames were so old when they were used [%].
Curve latencyShares(const SessionSummary& session, std::size_t camera, double longest_ms) {
  constexpr std::size_t kBins = 80;
  std::vector<double> bins(kBins, 0.0);
  double count = 0.0;
  for (const SessionSample& sample : session.samples) {
    const double latency = sample.cameras[camera].latency_ms;
    if (!(latency >= 0.0)) continue;
    ++bins[std::min(kBins - 1, static_cast<std::size_t>(latency / longest_ms * kBins))];
    ++count;
  }
  Curve steps{cameraStroke(camera), {}};
  for (std::size_t i = 0; count > 0.0 && i < kBins; ++i)
    for (const std::size_t edge : {i, i + 1})
      steps.points.emplace_back(longest_ms * static_cast<double>(edge) / kBins, 100.0 * bins[i] / count);
  return steps;
}

Figure histogramFigure(const SessionSummary& session) {
  std::vector<double> latencies;
  for (const SessionSample& sample : session.samples)
    for (const Camera& camera : sample.cameras)
      if (camera.latency_ms >= 0.0) latencies.push_back(camera.latency_ms);
  Figure figure{QStringLiteral("latency_histogram"),
                QStringLiteral("Age of the frames when they were used"),
                cameraKeys(session),
                {}};
  if (latencies.empty()) return figure;
  std::sort(latencies.begin(), latencies.end());
  const double longest = 1.2 * latencies[static_cast<std::size_t>(0.995 * static_cast<double>(latencies.size() - 1))];
  Panel shares;
  for (std::size_t c = 0; c < session.settings.rig.cameras.size(); ++c)
    shares.curves.push_back(latencyShares(session, c, std::max(1.0, longest)));
  shares.x = fittedAxis(QStringLiteral("mid-exposure to use [ms]"), 0.0, std::max(1.0, longest), 0.0);
  shares.y = fittedAxis(QStringLiteral("frames [%]"), shares.curves, 1.0, 100.0);
  figure.panels.push_back(std::move(shares));
  return figure;
}

Figure trackingFigure(const SessionSummary& session) {
  return {QStringLiteral("tracking"),
          QStringLiteral("Error of the tracked pose"),
          {{{QStringLiteral("error"), LegendKeyKind::kLine, kTrue},
            {QStringLiteral("sigma"), LegendKeyKind::kLine, kTracked}}},
          {panel(session, QStringLiteral("position [mm]"), 5.0, 100.0,
                 {curve(session, kTrue, [](const SessionSample& s) { return 1e3 * s.position_error; }),
                  curve(session, kTracked, [](const SessionSample& s) { return 1e3 * s.position_sigma; })}),
           panel(session, QStringLiteral("orientation [\u00b0]"), 1.0, 20.0,
                 {curve(session, kTrue,
                        [](const SessionSample& s) { return toDegrees(s.orientation_error); })})}};
}

Figure sticksFigure(const SessionSummary& session) {
  const Stroke upper{kExperimentB}, lower{kExperimentA}, roll{kGreen}, pitch{kPurple};
  return {QStringLiteral("sticks"),
          QStringLiteral("Stick positions"),
          {{{QStringLiteral("upper rotor"), LegendKeyKind::kLine, upper},
            {QStringLiteral("lower rotor"), LegendKeyKind::kLine, lower},
            {QStringLiteral("roll"), LegendKeyKind::kLine, roll},
            {QStringLiteral("pitch"), LegendKeyKind::kLine, pitch}}},
          {panel(session, QStringLiteral("rotors"), 0.5, kWithoutLimit,
                 {curve(session, upper, [](const SessionSample& s) { return s.sticks.upper_rotor; }),
                  curve(session, lower, [](const SessionSample& s) { return s.sticks.lower_rotor; })}),
           panel(session, QStringLiteral("swash plate"), 0.5, kWithoutLimit,
                 {curve(session, roll, [](const SessionSample& s) { return s.sticks.roll; }),
                  curve(session, pitch, [](const SessionSample& s) { return s.sticks.pitch; })})}};
}

Figure latencyFigure(const SessionSummary& session) {
  return {QStringLiteral("latency"),
          QStringLiteral("Latency, 99 % of the ticks so far"),
          {{{QStringLiteral("observation to command"), LegendKeyKind::kLine, kTracked},
            {QStringLiteral("frame to command"), LegendKeyKind::kLine, kTrue}}},
          {panel(session, QStringLiteral("latency [ms]"), 1.0, 100.0,
                 {curve(session, kTracked, [](const SessionSample& s) { return s.server_p99_ms; }),
                  curve(session, kTrue, [](const SessionSample& s) { return s.command_p99_ms; })})}};
}

}  // namespace

std::vector<Figure> sessionFigures(const SessionSummary& session) {
  const Panel yaw = coordinate(
      session, QStringLiteral("\u03b8 [rad]"), [](const SessionSample& s) { return s.yaw; },
      [](const SessionSample& s) { return s.true_yaw; },
      [](const SessionSample& s) { return s.reference_yaw; });
  std::vector<Figure> figures{
      {QStringLiteral("fig06"),
       QStringLiteral("Time profile of the generalized coordinates x and y"),
       coordinateKeys(),
       {coordinate(session, QStringLiteral("x [m]"), 0), coordinate(session, QStringLiteral("y [m]"), 1)}},
      {QStringLiteral("fig07"),
       QStringLiteral("Time profile of the generalized coordinates z and \u03b8"),
       coordinateKeys(),
       {coordinate(session, QStringLiteral("z [m]"), 2), yaw}},
      featuresFigure(session),
      errorFigure(session, "fig09", QStringLiteral("Calibration error: position"), QStringLiteral("[m]"),
                  0.02, 0.8, [](const Camera& camera) { return camera.position_error; }),
      errorFigure(
          session, "fig10", QStringLiteral("Calibration error: orientation"), QStringLiteral("[\u00b0]"), 1.0,
          40.0,
          [](const Camera& camera) -> Eigen::Vector3d { return toDegrees(1.0) * camera.rotation_error; }),
      coveredFeaturesFigure(session),
      trackingFigure(session),
      convergenceFigure(session),
      orientationFigure(session),
      camerasFigure(session, "residuals", QStringLiteral("Reprojection residual"), QStringLiteral("residual [px]"),
                    0.2, 5.0, [](const Camera& camera) { return camera.residual_px; }),
      camerasFigure(session, "sample_size", QStringLiteral("Effective sample size of the calibrators"),
                    QStringLiteral("hypotheses"), 10.0, kWithoutLimit,
                    [](const Camera& camera) { return camera.effective_sample_size; }),
      sticksFigure(session),
      latencyFigure(session),
      histogramFigure(session)};
  std::erase_if(figures, [](const Figure& figure) { return !hasData(figure); });
  return figures;
}

}  // namespace helical::figures
