#pragma once

#include <QPointF>
#include <QWidget>
#include <optional>
#include <vector>

#include "ui/plot_page.h"
#include "ui/time_axis.h"

class QCPAxisRect;
class QCPGraph;
class QCustomPlot;

namespace helical {

/// A stretch of time in which something was done to a camera or to the air.
struct PlotSpan {
  double begin = 0.0;  ///< s
  double end = 0.0;    ///< the same: a moment
  QColor color;
  QString text;
};

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
  const std::vector<PlotSpan>& spans() const { return spans_; }
  /// The time under the pointer [s].
  std::optional<double> hovered() const { return hovered_; }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  class SpanItem;
  class HeadingItem;
  struct Lane {
    PlotLane description;
    QCPAxisRect* rect = nullptr;
    std::vector<QCPGraph*> graphs;
  };

  void addLane(std::size_t index);
  void styleValueAxis(Lane& lane);
  void takeTheme();
  void fill(Lane& lane, std::int64_t begin, std::int64_t end, std::int64_t step);
  void fitRange(Lane& lane);
  void fitLogarithm(Lane& lane);
  void findSpans(std::int64_t begin, std::int64_t end, std::int64_t step);
  double timeAt(const QPointF& position) const;
  /// The row whose values the headings show.
  std::optional<std::int64_t> rowShown() const;
  double valueOf(const PlotSeries& series, std::int64_t row) const;
  bool writeCsv(const QString& path) const;
  void askAndSave(const QString& suffix);

  const RigConfig& rig_;
  const PlotPage page_;
  const TickHistory& history_;
  TimeAxis& axis_;
  QCustomPlot* plot_;
  std::vector<Lane> lanes_;
  std::vector<PlotSpan> spans_;
  std::optional<double> hovered_;
  std::optional<QPointF> drag_from_;
};

}  // namespace helical
