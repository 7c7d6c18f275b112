#include "ui/plot_axes.h"

#include <qcustomplot.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ui/theme.h"

namespace helical {
namespace {

constexpr int kTicks = 3;  // about, on a linear axis

void colourAxis(QCPAxis* axis) {
  axis->setBasePen(QPen(theme::kLine));
  axis->setTickLabelColor(theme::kMuted);
  axis->grid()->setPen(QPen(theme::kGrid, 1));
  axis->grid()->setZeroLinePen(QPen(theme::kLine, 1));
}

void styleAxis(QCPAxis* axis) {
  colourAxis(axis);
  axis->setTickPen(Qt::NoPen);
  axis->setSubTickPen(Qt::NoPen);
  axis->setTickLabelFont(theme::monoFont(7.4));
  axis->setTickLabelPadding(5);
}

void styleValueAxis(const DrawnLane& lane) {
  QCPAxis* value = lane.rect->axis(QCPAxis::atLeft);
  styleAxis(value);
  if (!lane.description.levels.empty()) {
    const QSharedPointer<QCPAxisTickerText> names(new QCPAxisTickerText);
    for (const PlotLevel& level : lane.description.levels) names->addTick(level.value, level.name);
    value->setTicker(names);
    value->setTickLabelFont(theme::uiFont(8));
    value->grid()->setVisible(false);
  } else if (lane.description.logarithmic) {
    value->setScaleType(QCPAxis::stLogarithmic);
    const QSharedPointer<QCPAxisTickerLog> decades(new QCPAxisTickerLog);
    value->setTicker(decades);
    value->setNumberFormat(QStringLiteral("g"));
    value->setNumberPrecision(6);
  } else {
    value->setNumberFormat(QStringLiteral("f"));
    value->ticker()->setTickCount(kTicks);
  }
}

struct Extent {
  double low = std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::lowest();
  bool empty() const { return low > high; }
};

Extent extentOf(const DrawnLane& lane, QCP::SignDomain domain) {
  Extent extent;
  for (const QCPGraph* graph : lane.graphs) {
    bool found = false;
    const QCPRange range = graph->getValueRange(found, domain);
    if (!found) continue;
    extent.low = std::min(extent.low, range.lower);
    extent.high = std::max(extent.high, range.upper);
  }
  return extent;
}

void fitLevels(const DrawnLane& lane) {
  Extent extent;
  for (const PlotSeries& series : lane.description.series) {
    extent.low = std::min(extent.low, series.level);
    extent.high = std::max(extent.high, series.level);
  }
  lane.rect->axis(QCPAxis::atLeft)->setRange(extent.low - 0.8, extent.high + 0.8);
}

/// Whole decades.
void fitLogarithm(const DrawnLane& lane) {
  Extent extent = extentOf(lane, QCP::sdPositive);
  if (extent.empty()) extent.low = extent.high = 1.0;
  const double lowest = std::floor(std::log10(extent.low)), highest = std::ceil(std::log10(extent.high));
  lane.rect->axis(QCPAxis::atLeft)
      ->setRange(std::pow(10.0, lowest), std::pow(10.0, std::max(highest, lowest + 2.0)));
}

/// As many as show every tick exactly: they are 1, 2, 2.5 or 5 times a power of ten apart.
int digitsOfTicks(double range) {
  const double step = range / kTicks, decade = std::floor(std::log10(step)), mantissa = step / std::pow(10.0, decade);
  const bool quarters = mantissa > 2.25 && mantissa < 3.75;  // QCPAxisTicker takes the nearest
  const bool next_decade = mantissa > 7.5;
  return std::clamp(static_cast<int>(-decade) + (quarters ? 1 : 0) - (next_decade ? 1 : 0), 0, 5);
}

/// Whole steps, so that the axis does not tremble with the noise.
void fitLinear(const DrawnLane& lane) {
  const PlotLane& description = lane.description;
  Extent extent = extentOf(lane, QCP::sdBoth);
  if (extent.empty()) extent.low = extent.high = 0.0;
  const double step = 0.5 * description.smallest_span;
  const double pad = std::max(0.15 * (extent.high - extent.low), 0.2 * step);
  const double low = description.one_sided ? 0.0 : step * std::floor((extent.low - pad) / step);
  const double high = step * std::ceil((extent.high + pad) / step);
  const double margin = 0.01 * (high - low);  // or the outermost labels fall off the axis
  const double top = std::max(high, low + description.smallest_span);
  QCPAxis* axis = lane.rect->axis(QCPAxis::atLeft);
  axis->setRange(low - margin, top + margin);
  axis->setNumberPrecision(digitsOfTicks(axis->range().size()));
}

}  // namespace

void buildLane(QCustomPlot& plot, DrawnLane& lane, int row, int column, bool lowest) {
  lane.rect = new QCPAxisRect(&plot);
  plot.plotLayout()->addElement(row, column, lane.rect);
  lane.rect->setAutoMargins(QCP::msNone);
  lane.rect->setMargins(QMargins(lane.description.levels.empty() ? 50 : 84, 21, 12, lowest ? 21 : 5));
  QCPAxis* time = lane.rect->axis(QCPAxis::atBottom);
  styleAxis(time);
  time->setTickLabels(lowest);
  time->setNumberFormat(QStringLiteral("f"));
  time->setNumberPrecision(0);
  styleValueAxis(lane);
  for (const PlotSeries& series : lane.description.series) {
    QCPGraph* graph = plot.addGraph(time, lane.rect->axis(QCPAxis::atLeft));
    QPen pen(series.color, series.width, series.style);
    pen.setCapStyle(Qt::FlatCap);
    graph->setPen(pen);
    graph->setAntialiased(series.bit < 0);  // bars would show seams between their ticks
    lane.graphs.push_back(graph);
  }
}

void recolour(DrawnLane& lane) {
  for (const auto type : {QCPAxis::atBottom, QCPAxis::atLeft}) colourAxis(lane.rect->axis(type));
  for (std::size_t i = 0; i < lane.graphs.size(); ++i) {
    PlotSeries& series = lane.description.series[i];
    series.color = theme::translated(series.color);
    QPen pen = lane.graphs[i]->pen();
    pen.setColor(series.color);
    lane.graphs[i]->setPen(pen);
  }
}

void fitRange(DrawnLane& lane) {
  if (!lane.description.levels.empty())
    fitLevels(lane);
  else if (lane.description.logarithmic)
    fitLogarithm(lane);
  else
    fitLinear(lane);
}

}  // namespace helical
