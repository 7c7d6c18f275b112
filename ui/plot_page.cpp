#include "ui/plot_page.h"

#include <QCoreApplication>

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
    result.series.push_back(
        line(name(tr("sigma")), history.column(camera, columns.sigma), color, scale, Qt::DashLine));
    result.series.push_back(
        line(name(tr("bound")), history.column(camera, columns.bound), theme::kMuted, scale, Qt::DotLine));
    if (simulated(rig, camera))
      result.series.push_back(line(name(tr("error")), history.column(camera, columns.error), color, scale));
  }
  return result;
}

PlotLane residuals(const RigConfig& rig, const TickHistory& history) {
  PlotLane result = lane(tr("Reprojection residual"), tr("px"), 0.2, 2);
  result.one_sided = true;
  for (int camera = 0; camera < history.cameras(); ++camera)
    result.series.push_back(line(history.cameras() <= 4 ? nameOf(rig, camera) : QString(),
                                 history.column(camera, CameraColumn::kResidual),
                                 theme::cameraColor(camera)));
  return result;
}

}  // namespace

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
    effective.series.push_back(line(history.cameras() <= 4 ? nameOf(rig, camera) : QString(),
                                    history.column(camera, CameraColumn::kEffective),
                                    theme::cameraColor(camera)));
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
