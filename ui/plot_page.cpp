#include "ui/plot_page.h"

#include <QCoreApplication>
#include <limits>

#include "ui/theme.h"

namespace helical {
namespace {

QString tr(const char* text) {
  return QCoreApplication::translate("PlotPage", text);
}

PlotSeries line(const QString& name, int column, const QColor& color, double scale = 1.0,
                Qt::PenStyle style = Qt::SolidLine) {
  PlotSeries series;
  series.name = name;
  series.column = column;
  series.color = color;
  series.scale = scale;
  series.style = style;
  if (style != Qt::SolidLine) series.width = 1.2;
  return series;
}

PlotLane lane(const QString& title, const QString& unit, double smallest_span, int decimals) {
  PlotLane result;
  result.title = title;
  result.unit = unit;
  result.smallest_span = smallest_span;
  result.decimals = decimals;
  return result;
}

PlotLane followed(const QString& title, const QString& unit, FlightColumn measured, FlightColumn reference,
                  double smallest_span, int decimals) {
  PlotLane result = lane(title, unit, smallest_span, decimals);
  result.series = {line(tr("set-point"), TickHistory::column(reference), theme::kCaution, 1.0, Qt::DashLine),
                   line(tr("tracked"), TickHistory::column(measured), theme::kActive)};
  return result;
}

/// Cameras without a known place first; any other learns one when it is knocked.
std::vector<int> learningCameras(const RigConfig& rig) {
  std::vector<int> cameras;
  for (const bool learns : {true, false})
    for (std::size_t i = 0; i < rig.cameras.size(); ++i)
      if (rig.cameras[i].learns() == learns) cameras.push_back(static_cast<int>(i));
  return cameras;
}

QString nameOf(const RigConfig& rig, int camera) {
  return QString::fromStdString(rig.cameras[static_cast<std::size_t>(camera)].name);
}

bool simulated(const RigConfig& rig, int camera) {
  return rig.cameras[static_cast<std::size_t>(camera)].source == "sim";
}

struct ConvergenceColumns {
  CameraColumn error;
  CameraColumn sigma;
  CameraColumn bound;
};

/// Error solid where it is known, sigma dashed, the Cramer-Rao bound dotted.
PlotLane convergence(const RigConfig& rig, const TickHistory& history, const QString& title,
                     const QString& unit, const ConvergenceColumns& columns, double scale) {
  PlotLane result = lane(title, unit, 1.0, 3);
  result.logarithmic = true;
  result.one_sided = true;
  const std::vector<int> cameras = learningCameras(rig);
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const int camera = cameras[i];
    // The first one's names stand for all: the colour tells the camera.
    const auto name = [first = i == 0](const QString& text) { return first ? text : QString(); };
    const QColor color = theme::cameraColor(camera);
    const auto add = [&](const QString& what, CameraColumn column, const QColor& shade, Qt::PenStyle style) {
      PlotSeries series = line(name(what), history.column(camera, column), shade, scale, style);
      series.column_name = nameOf(rig, camera) + QLatin1Char(' ') + what;
      result.series.push_back(series);
    };
    add(tr("sigma"), columns.sigma, color, Qt::DashLine);
    add(tr("bound"), columns.bound, theme::kMuted, Qt::DotLine);
    if (simulated(rig, camera)) add(tr("error"), columns.error, color, Qt::SolidLine);
  }
  result.empty = tr("No camera is learning its place");
  return result;
}

/// Named in the heading where there are few cameras.
PlotSeries cameraLine(const RigConfig& rig, const TickHistory& history, int camera, CameraColumn column) {
  PlotSeries series = line(history.cameras() <= 4 ? nameOf(rig, camera) : QString(), history.column(camera, column),
                           theme::cameraColor(camera));
  series.column_name = nameOf(rig, camera);
  return series;
}

PlotLane residuals(const RigConfig& rig, const TickHistory& history) {
  PlotLane result = lane(tr("Reprojection residual"), tr("px"), 0.2, 2);
  result.one_sided = true;
  for (int camera = 0; camera < history.cameras(); ++camera)
    result.series.push_back(cameraLine(rig, history, camera, CameraColumn::kResidual));
  result.empty = tr("No camera is used");
  return result;
}

/// The labellings of every camera's calibration, the one that it took as a thick line.
PlotLane labellings(const RigConfig& rig, const TickHistory& history, const QString& title, const QString& unit,
                    bool by_misfit) {
  PlotLane result = lane(title, unit, 1.0, 3);
  result.logarithmic = true;
  result.one_sided = true;
  for (const int camera : learningCameras(rig))
    for (int place = 0; place < TriedLabellings::kMost; ++place) {
      const auto column = static_cast<CameraColumn>(static_cast<int>(CameraColumn::kLabelling1) + place);
      PlotSeries series = cameraLine(rig, history, camera, column);
      series.column_name = tr("%1 labelling %2").arg(nameOf(rig, camera)).arg(place + 1);
      series.condition = history.column(camera, CameraColumn::kByMisfit);
      series.condition_value = by_misfit ? 1.0 : 0.0;
      if (place > 0) {
        series.name.clear();
        series.style = Qt::DotLine;
        series.width = 1.2;
      } else {
        series.width = 2.2;
      }
      result.series.push_back(series);
    }
  return result;
}

}  // namespace

double valueOf(const PlotSeries& series, const TickHistory& history, std::int64_t row) {
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  if (series.condition >= 0 && history.value(row, series.condition) != series.condition_value) return kNothing;
  const double value = history.value(row, series.column);
  if (series.bit < 0) return value * series.scale;
  const bool set = (static_cast<std::uint32_t>(value) >> series.bit & 1U) != 0;
  return set ? series.level : kNothing;
}

PlotPage flightPage() {
  PlotPage page;
  page.name = tr("Flight");
  page.tip = tr("Position and heading of the helicopter with their references");
  page.lanes = {followed(tr("X"), tr("m"), FlightColumn::kX, FlightColumn::kReferenceX, 0.2, 3),
                followed(tr("Z"), tr("m"), FlightColumn::kZ, FlightColumn::kReferenceZ, 0.2, 3),
                followed(tr("Y"), tr("m"), FlightColumn::kY, FlightColumn::kReferenceY, 0.2, 3),
                followed(tr("Yaw"), tr("deg"), FlightColumn::kYaw, FlightColumn::kReferenceYaw, 10.0, 1)};
  return page;
}

PlotPage trackingPage(const RigConfig& rig, const TickHistory& history) {
  PlotPage page;
  page.name = tr("Tracking");
  page.tip = tr("How well the helicopter is known, what is sent to it, how long that takes");
  const bool truth = !rig.cameras.empty() && simulated(rig, 0);
  PlotLane position = lane(tr("Helicopter position"), tr("mm"), 4.0, 1);
  position.one_sided = true;
  position.series.push_back(line(tr("sigma"), TickHistory::column(FlightColumn::kPositionSigma),
                                 theme::kActive, 1e3, Qt::DashLine));
  if (truth)
    position.series.push_back(
        line(tr("error"), TickHistory::column(FlightColumn::kPositionError), theme::kActive, 1e3));
  PlotLane sticks = lane(tr("Sticks"), tr("%"), 40.0, 0);
  sticks.series = {
      line(tr("upper"), TickHistory::column(FlightColumn::kUpperRotor), theme::kActive, 100.0),
      line(tr("lower"), TickHistory::column(FlightColumn::kLowerRotor), theme::cameraColor(3), 100.0),
      line(tr("roll"), TickHistory::column(FlightColumn::kRoll), theme::cameraColor(2), 100.0),
      line(tr("pitch"), TickHistory::column(FlightColumn::kPitch), theme::cameraColor(6), 100.0)};
  PlotLane latency = lane(tr("Latency (99 %)"), tr("ms"), 2.0, 2);
  latency.one_sided = true;
  latency.logarithmic = true;
  latency.series = {line(tr("server"), TickHistory::column(FlightColumn::kServerLatency), theme::kActive),
                    line(tr("frame to command"), TickHistory::column(FlightColumn::kCommandLatency),
                         theme::cameraColor(2))};
  page.lanes = {position, sticks, residuals(rig, history), latency};
  return page;
}

PlotPage calibrationPage(const RigConfig& rig, const TickHistory& history) {
  PlotPage page;
  page.name = tr("Calibration");
  page.tip = tr("How the cameras without a known place find theirs");
  page.empty = tr("No camera of this rig is calibrated in flight.");
  if (learningCameras(rig).empty()) return page;
  PlotLane effective = lane(tr("Effective sample size"), {}, 100.0, 0);
  effective.one_sided = true;
  for (const int camera : learningCameras(rig))
    effective.series.push_back(cameraLine(rig, history, camera, CameraColumn::kEffective));
  effective.empty = tr("Only for particle filters");
  page.lanes = {
      convergence(rig, history, tr("Camera position"), tr("mm"),
                  {CameraColumn::kPositionError, CameraColumn::kPositionSigma, CameraColumn::kPositionBound},
                  1e3),
      effective,
      convergence(
          rig, history, tr("Camera orientation"), tr("deg"),
          {CameraColumn::kOrientationError, CameraColumn::kOrientationSigma, CameraColumn::kOrientationBound},
          1.0),
      residuals(rig, history)};
  return page;
}

PlotPage labellingPage(const RigConfig& rig, const TickHistory& history) {
  PlotPage page;
  page.name = tr("Labels");
  page.tip = tr("How well each labelling of the balls explains what a camera without a known place sees");
  page.empty = tr("No camera of this rig is calibrated in flight.");
  if (learningCameras(rig).empty()) return page;
  page.lanes = {labellings(rig, history, tr("De per labelling"), tr("m"), false),
                labellings(rig, history, tr("Misfit per labelling"), tr("standard deviations"), true)};
  page.lanes[0].empty = tr("Only where labellings are chosen by their distance from the first guess (nested polygons)");
  page.lanes[1].empty = tr("Only for the method \"joint\", which chooses them by their misfit");
  return page;
}

PlotPage featurePage(const RigConfig& rig, const TickHistory& history) {
  PlotPage page;
  page.name = tr("Features");
  page.tip = tr("Which markers of which camera the pose was found from");
  page.columns = 1;
  PlotLane raster = lane(tr("Selected features"), {}, 1.0, 0);
  const int markers = rig.markers_in_body.count();
  for (int camera = 0; camera < history.cameras(); ++camera) {
    // Camera 1 on top, a row's gap between cameras.
    const double top = (history.cameras() - 1 - camera) * (markers + 1.0) + markers;
    for (int marker = 0; marker < markers; ++marker) {
      PlotSeries series =
          line({}, history.column(camera, CameraColumn::kSelected), theme::cameraColor(camera));
      series.width = 0.0;  // as thick as its row allows
      series.bit = marker;
      series.level = top - marker;
      raster.series.push_back(series);
    }
    raster.levels.insert(raster.levels.begin(), {top - 0.5 * (markers - 1), nameOf(rig, camera)});
  }
  page.lanes = {raster};
  return page;
}

}  // namespace helical
