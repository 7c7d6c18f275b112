#include "ui/time_plots.h"

#include <qcustomplot.h>

#include <QContextMenuEvent>
#include <QLabel>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <limits>

#include "ui/plot_saving.h"
#include "ui/theme.h"

namespace helical {
namespace {

constexpr std::int64_t kShownPoints = 1800;  // per line: about one a pixel
constexpr double kZoomPerStep = 0.85;

}  // namespace

TimePlots::TimePlots(const RigConfig& rig, const PlotPage& page, const TickHistory& history, TimeAxis& axis,
                     QWidget* parent)
    : QWidget(parent),
      rig_(rig),
      page_(page),
      history_(history),
      axis_(axis),
      plot_(new QCustomPlot),
      readout_{history, axis, {}, {}} {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  setMinimumSize(360, 150);
  setAccessibleName(tr("Plots: %1").arg(page.name));
  plot_->setParent(this);
  if (page_.lanes.empty()) {
    plot_->hide();
    auto* note = new QLabel(page_.empty);
    note->setAlignment(Qt::AlignCenter);
    note->setForegroundRole(QPalette::PlaceholderText);
    layout->addWidget(note);
    return;
  }
  layout->addWidget(plot_);
  plot_->setBackground(theme::kPanel);
  plot_->setPlottingHints(QCP::phFastPolylines | QCP::phCacheLabels);
  plot_->setContextMenuPolicy(Qt::NoContextMenu);
  plot_->plotLayout()->clear();
  plot_->plotLayout()->setRowSpacing(0);
  plot_->plotLayout()->setColumnSpacing(6);
  lanes_.resize(page_.lanes.size());
  for (std::size_t i = 0; i < lanes_.size(); ++i) addLane(i);
  plot_->setMouseTracking(true);
  plot_->installEventFilter(this);
}

void TimePlots::addLane(std::size_t index) {
  lanes_[index].description = page_.lanes[index];
  const int row = static_cast<int>(index) / page_.columns, column = static_cast<int>(index) % page_.columns;
  const bool lowest = index + static_cast<std::size_t>(page_.columns) >= lanes_.size();
  buildLane(*plot_, lanes_[index], row, column, lowest);
  addItems(*plot_, readout_, lanes_[index], lowest);
}

void TimePlots::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange) takeTheme();
}

void TimePlots::takeTheme() {
  plot_->setBackground(theme::kPanel);
  for (DrawnLane& lane : lanes_) recolour(lane);
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

void TimePlots::fill(DrawnLane& lane, const PlotRows& rows) {
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  const double row_height =
      lane.rect->height() / std::max(1.0, lane.rect->axis(QCPAxis::atLeft)->range().size());
  lane.blank = true;
  for (std::size_t i = 0; i < lane.graphs.size(); ++i) {
    const PlotSeries& series = lane.description.series[i];
    QVector<QCPGraphData> points;
    points.reserve(static_cast<int>((rows.end - rows.begin) / rows.step) + 2);
    for (std::int64_t row = rows.begin; row < rows.end; row += rows.step) {
      const double value = valueOf(series, history_, row);
      const bool drawable = std::isfinite(value) && (!lane.description.logarithmic || value > kLowestLogarithm);
      lane.blank = lane.blank && !drawable;
      points.append(QCPGraphData(history_.time(row), drawable ? value : kNothing));
    }
    lane.graphs[i]->data()->set(points, true);
    if (series.bit < 0) continue;
    QPen pen = lane.graphs[i]->pen();
    pen.setWidthF(std::clamp(0.62 * row_height, 2.0, 12.0));
    lane.graphs[i]->setPen(pen);
  }
}

void TimePlots::redraw() {
  if (lanes_.empty()) return;
  PlotRows rows{history_.rowAt(axis_.begin()), history_.rowAt(axis_.end() + 1e-6), 1};
  rows.step = (rows.end - rows.begin) / kShownPoints + 1;
  // The same rows whatever is newest, or the lines would shimmer.
  rows.begin = std::max(history_.first(), rows.begin / rows.step * rows.step);
  readout_.spans = findSpans(rig_, history_, rows);
  for (DrawnLane& lane : lanes_) {
    fill(lane, rows);
    lane.rect->axis(QCPAxis::atBottom)->setRange(axis_.begin(), axis_.end());
    fitRange(lane);
  }
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

double TimePlots::timeAt(const QPointF& position) const {
  for (const DrawnLane& lane : lanes_)
    if (lane.rect->outerRect().contains(position.toPoint()))
      return lane.rect->axis(QCPAxis::atBottom)->pixelToCoord(position.x());
  return lanes_.front().rect->axis(QCPAxis::atBottom)->pixelToCoord(position.x());
}

bool TimePlots::eventFilter(QObject* watched, QEvent* event) {
  if (watched != plot_) return QWidget::eventFilter(watched, event);
  switch (event->type()) {
    case QEvent::MouseMove: {
      const QPointF position = static_cast<QMouseEvent*>(event)->position();
      if (drag_from_) {
        axis_.scroll(timeAt(*drag_from_) - timeAt(position));
        drag_from_ = position;
      }
      readout_.hovered = timeAt(position);
      plot_->replot(QCustomPlot::rpQueuedReplot);
      return true;
    }
    case QEvent::MouseButtonPress:
      if (static_cast<QMouseEvent*>(event)->button() == Qt::LeftButton)
        drag_from_ = static_cast<QMouseEvent*>(event)->position();
      return true;
    case QEvent::MouseButtonRelease:
      drag_from_.reset();
      return true;
    case QEvent::MouseButtonDblClick:
      drag_from_.reset();
      axis_.setLive(true);
      return true;
    case QEvent::Wheel: {
      const auto* wheel = static_cast<QWheelEvent*>(event);
      axis_.zoom(std::pow(kZoomPerStep, wheel->angleDelta().y() / 120.0), timeAt(wheel->position()));
      return true;
    }
    case QEvent::Leave:
      readout_.hovered.reset();
      plot_->replot(QCustomPlot::rpQueuedReplot);
      return false;
    default:
      return QWidget::eventFilter(watched, event);
  }
}

void TimePlots::contextMenuEvent(QContextMenuEvent* event) {
  if (lanes_.empty()) return;
  offerToSave(this, event->globalPos(), page_.name, [this](const QString& path) { return save(path); });
}

bool TimePlots::save(const QString& path) {
  if (path.endsWith(QStringLiteral(".csv"), Qt::CaseInsensitive))
    return saveText(path, tableOf(page_.lanes, history_, history_.rowAt(axis_.begin()),
                                  history_.rowAt(axis_.end() + 1e-6)));
  plot_->replot(QCustomPlot::rpImmediateRefresh);
  if (path.endsWith(QStringLiteral(".pdf"), Qt::CaseInsensitive))
    return plot_->savePdf(path, 0, 0, QCP::epNoCosmetic, QStringLiteral("Helical"), page_.name);
  return plot_->savePng(path, 0, 0, 2.0);
}

int TimePlots::pointCount(int lane, int series) const {
  const QCPGraph* graph = lanes_[static_cast<std::size_t>(lane)].graphs[static_cast<std::size_t>(series)];
  return static_cast<int>(
      std::count_if(graph->data()->constBegin(), graph->data()->constEnd(),
                    [](const QCPGraphData& point) { return std::isfinite(point.value); }));
}

QString TimePlots::note(int lane) const {
  const DrawnLane& drawn = lanes_[static_cast<std::size_t>(lane)];
  return drawn.blank ? drawn.description.empty : QString();
}

}  // namespace helical
