#include "ui/flight_plots.h"

#include <qcustomplot.h>

#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/geometry/rotation.h"
#include "ui/status_words.h"
#include "ui/theme.h"

namespace helical {
namespace {

constexpr double kShownSeconds = 30.0;
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

struct SeriesStyle {
  const char* name;
  double smallest_span;
  QColor color;
};

const std::array<SeriesStyle, FlightPlots::kSeries> kStyles{
    {{QT_TRANSLATE_NOOP("FlightPlots", "X  m"), 0.2, theme::kActive},
     {QT_TRANSLATE_NOOP("FlightPlots", "Y  m"), 0.2, theme::kActive},
     {QT_TRANSLATE_NOOP("FlightPlots", "Z  m"), 0.2, theme::kActive},
     {QT_TRANSLATE_NOOP("FlightPlots", "Yaw  deg"), 10.0, theme::kActive}}};

void styleAxis(QCPAxis* axis) {
  axis->setBasePen(QPen(theme::kLine));
  axis->setTickPen(Qt::NoPen);
  axis->setSubTickPen(Qt::NoPen);
  axis->setTickLabelFont(theme::monoFont(7.4));
  axis->setTickLabelColor(theme::kMuted);
  axis->grid()->setPen(QPen(theme::kGrid, 1));
  axis->grid()->setZeroLinePen(QPen(theme::kLine.lighter(125), 1));
  axis->setTickLabelPadding(5);
}

}  // namespace

FlightPlots::FlightPlots(QWidget* parent) : QWidget(parent), plot_(new QCustomPlot) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(plot_);
  setMinimumSize(360, 150);
  setAccessibleName(tr("Plots of x, y, z and yaw with their references"));
  plot_->setBackground(theme::kPanel);
  plot_->setPlottingHints(QCP::phFastPolylines | QCP::phCacheLabels);
  plot_->plotLayout()->clear();
  plot_->plotLayout()->setRowSpacing(2);
  plot_->plotLayout()->setColumnSpacing(6);
  for (int i = 0; i < kSeries; ++i) addSeries(i);
}

void FlightPlots::addSeries(int index) {
  const SeriesStyle& style = kStyles[static_cast<std::size_t>(index)];
  Series& series = series_[static_cast<std::size_t>(index)];
  series.smallest_span = style.smallest_span;
  series.rect = new QCPAxisRect(plot_);
  // x over y on the left, z over yaw on the right; only the lower ones carry the time.
  const bool lower = index % 2 == 1;
  plot_->plotLayout()->addElement(index % 2, index / 2, series.rect);
  series.rect->setAutoMargins(QCP::msNone);
  series.rect->setMargins(QMargins(50, 8, 10, lower ? 22 : 8));
  QCPAxis* time = series.rect->axis(QCPAxis::atBottom);
  QCPAxis* value = series.rect->axis(QCPAxis::atLeft);
  styleAxis(time);
  styleAxis(value);
  time->setTickLabels(lower);
  time->setNumberFormat(QStringLiteral("f"));
  time->setNumberPrecision(0);
  value->setNumberFormat(QStringLiteral("f"));
  value->setNumberPrecision(index == 3 ? 1 : 2);
  value->ticker()->setTickCount(3);

  series.reference = plot_->addGraph(time, value);
  series.reference->setPen(QPen(theme::kCaution, 1.2, Qt::DashLine));
  series.measured = plot_->addGraph(time, value);
  series.measured->setPen(QPen(style.color, 1.5));

  auto* name = new QCPItemText(plot_);
  name->setClipToAxisRect(false);
  name->position->setType(QCPItemPosition::ptAxisRectRatio);
  name->position->setAxisRect(series.rect);
  name->position->setCoords(0.0, 0.0);
  name->setPositionAlignment(Qt::AlignLeft | Qt::AlignTop);
  name->setPadding(QMargins(6, 2, 6, 2));
  name->setText(tr(style.name));
  name->setFont(theme::uiFont(8, QFont::DemiBold));
  name->setColor(theme::kText);
  name->setBrush(QColor(16, 21, 28, 190));
}

void FlightPlots::addTick(const EngineSnapshot& tick) {
  const double time = toSeconds(tick.time);
  const RigidTransform& pose = tick.tracked.state.world_from_body;
  const double yaw = yawOf(pose.rotation);
  std::array<double, kSeries> measured{kNothing, kNothing, kNothing, kNothing};
  if (tick.pose_known) {
    yaw_deg_ += toDegrees(wrapAngle(yaw - toRadians(yaw_deg_)));
    measured = {pose.translation.x(), pose.translation.y(), pose.translation.z(), yaw_deg_};
  }
  std::array<double, kSeries> reference{kNothing, kNothing, kNothing, kNothing};
  if (hasReference(tick)) {
    const Eigen::Vector3d& place = tick.set_point.position_in_world;
    reference = {place.x(), place.y(), place.z(),
                 yaw_deg_ + toDegrees(wrapAngle(tick.set_point.yaw - toRadians(yaw_deg_)))};
  }
  for (std::size_t i = 0; i < kSeries; ++i) {
    series_[i].measured->addData(time, measured[i]);
    series_[i].reference->addData(time, reference[i]);
  }
}

void FlightPlots::fitRange(Series& series, double from) {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
  for (const QCPGraph* graph : {series.measured, series.reference}) {
    bool found = false;
    const QCPRange range = graph->getValueRange(found, QCP::sdBoth, QCPRange(from, from + 2 * kShownSeconds));
    if (!found) continue;
    low = std::min(low, range.lower);
    high = std::max(high, range.upper);
  }
  if (low > high) low = high = 0.0;
  // Whole steps, so that the axis does not tremble with the noise.
  const double step = 0.5 * series.smallest_span;
  const double pad = std::max(0.15 * (high - low), 0.2 * step);
  low = step * std::floor((low - pad) / step);
  high = step * std::ceil((high + pad) / step);
  const double margin = 0.01 * (high - low);  // or the outermost labels fall off the axis
  series.rect->axis(QCPAxis::atLeft)
      ->setRange(low - margin, std::max(high, low + series.smallest_span) + margin);
}

void FlightPlots::redraw(TimeNs now) {
  const double end = std::max(kShownSeconds, toSeconds(now));
  const double begin = end - kShownSeconds;
  for (Series& series : series_) {
    series.measured->data()->removeBefore(begin - 1.0);
    series.reference->data()->removeBefore(begin - 1.0);
    series.rect->axis(QCPAxis::atBottom)->setRange(begin, end);
    fitRange(series, begin);
  }
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

int FlightPlots::pointCount(int series) const {
  return series_[static_cast<std::size_t>(series)].measured->dataCount();
}

}  // namespace helical
