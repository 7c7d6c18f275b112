#pragma once

#include <QPointF>
#include <QWidget>
#include <optional>
#include <vector>

#include "ui/plot_axes.h"
#include "ui/plot_items.h"

class QCustomPlot;

namespace helical {

/// One sheet of plots on the shared time axis. Drag scrolls, the wheel zooms, a double click follows again;
/// the pointer's time is read out in every lane's heading; right click saves. Spans of covered cameras,
/// knocks and gusts lie behind all lanes.
class TimePlots : public QWidget {
  Q_OBJECT

 public:
  TimePlots(const RigConfig& rig, const PlotPage& page, const TickHistory& history, TimeAxis& axis,
            QWidget* parent = nullptr);

  const PlotPage& page() const { return page_; }
  void redraw();

  /// By the suffix: png, pdf, or csv (every tick of the shown time). False if it cannot be written.
  bool save(const QString& path);

  /// For what is shown: points of one line, and the spans.
  int pointCount(int lane, int series) const;
  const std::vector<PlotSpan>& spans() const { return readout_.spans; }
  /// What a lane says instead of lines; empty where there are some.
  QString note(int lane) const;
  /// The time under the pointer [s].
  std::optional<double> hovered() const { return readout_.hovered; }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void addLane(std::size_t index);
  void takeTheme();
  void fill(DrawnLane& lane, const PlotRows& rows);
  double timeAt(const QPointF& position) const;

  const RigConfig& rig_;
  const PlotPage page_;
  const TickHistory& history_;
  TimeAxis& axis_;
  QCustomPlot* plot_;
  std::vector<DrawnLane> lanes_;
  PlotReadout readout_;
  std::optional<QPointF> drag_from_;
};

}  // namespace helical
