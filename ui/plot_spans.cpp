#include "ui/plot_spans.h"

#include <QCoreApplication>

#include "ui/theme.h"

namespace helical {
namespace {

QString tr(const char* text) {
  return QCoreApplication::translate("PlotSpans", text);
}

/// While a column is set.
void addWhile(std::vector<PlotSpan>& spans, const TickHistory& history, const PlotRows& rows, int column,
              const PlotSpan& look) {
  bool open = false;
  for (std::int64_t row = rows.begin; row < rows.end; row += rows.step) {
    const bool on = history.value(row, column) > 0.5;
    if (on && !open) spans.push_back({history.time(row), history.time(row), look.color, look.text});
    if (on) spans.back().end = history.time(row) + 1e-3;
    open = on;
  }
}

/// Whenever a column grows.
void addMoments(std::vector<PlotSpan>& spans, const TickHistory& history, const PlotRows& rows, int column,
                const PlotSpan& look) {
  for (std::int64_t row = rows.begin + rows.step; row < rows.end; row += rows.step)
    if (history.value(row, column) > history.value(row - rows.step, column))
      spans.push_back({history.time(row), history.time(row), look.color, look.text});
}

}  // namespace

std::vector<PlotSpan> findSpans(const RigConfig& rig, const TickHistory& history, const PlotRows& rows) {
  std::vector<PlotSpan> spans;
  for (int camera = 0; camera < history.cameras(); ++camera) {
    const QString name = QString::fromStdString(rig.cameras[static_cast<std::size_t>(camera)].name);
    const QColor color = theme::cameraColor(camera);
    addWhile(spans, history, rows, history.column(camera, CameraColumn::kCovered),
             {0.0, 0.0, color, tr("%1 covered").arg(name)});
    addWhile(spans, history, rows, history.column(camera, CameraColumn::kTampered),
             {0.0, 0.0, color, tr("%1 disturbed").arg(name)});
    addMoments(spans, history, rows, history.column(camera, CameraColumn::kKnocks),
               {0.0, 0.0, color, tr("%1 knocked").arg(name)});
  }
  addWhile(spans, history, rows, TickHistory::column(FlightColumn::kGust), {0.0, 0.0, theme::kActive, tr("gust")});
  return spans;
}

}  // namespace helical
