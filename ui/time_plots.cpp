#include "ui/time_plots.h"

#include <qcustomplot.h>

#include <QContextMenuEvent>
#include <QFile>
#include <QLabel>
#include <QMenu>
#include <QTextStream>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <limits>

#include "ui/format.h"
#include "ui/open_dialog.h"
#include "ui/theme.h"

namespace helical {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t kShownPoints = 1800;  // per line: about one a pixel
constexpr double kZoomPerStep = 0.85;
constexpr double kLowestLogarithm = 1e-4;

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

QString valueText(double value, const PlotLane& lane) {
  if (!std::isfinite(value)) return kNoValue;
  return lane.one_sided ? plainNumber(value, lane.decimals) : signedNumber(value, lane.decimals);
}

}  // namespace

/// Spans and the pointer's time, behind the lines.
class TimePlots::SpanItem : public QCPAbstractItem {
 public:
  SpanItem(QCustomPlot* plot, QCPAxisRect* rect, const TimePlots& owner)
      : QCPAbstractItem(plot), rect_(rect), owner_(owner) {
    setLayer(QStringLiteral("background"));
    setClipAxisRect(rect);
    setClipToAxisRect(true);
  }
  double selectTest(const QPointF&, bool, QVariant*) const override { return -1.0; }

 protected:
  void draw(QCPPainter* painter) override {
    const QCPAxis* time = rect_->axis(QCPAxis::atBottom);
    for (const PlotSpan& span : owner_.spans_) {
      const double left = time->coordToPixel(span.begin);
      const double right = std::max(left + 1.5, time->coordToPixel(span.end));
      const bool moment = span.end <= span.begin;
      QColor fill = span.color;
      fill.setAlpha(moment ? 170 : 30);
      painter->fillRect(QRectF(left, rect_->top(), right - left, rect_->height()), fill);
    }
    if (!owner_.hovered_) return;
    painter->setPen(QPen(theme::kFaint, 1));
    const double x = time->coordToPixel(*owner_.hovered_);
    painter->drawLine(QPointF(x, rect_->top()), QPointF(x, rect_->bottom()));
  }

 private:
  QCPAxisRect* rect_;
  const TimePlots& owner_;
};

/// Title and legend of a lane with the values at the pointer, else the newest; the names of the spans.
class TimePlots::HeadingItem : public QCPAbstractItem {
 public:
  HeadingItem(QCustomPlot* plot, const TimePlots& owner, std::size_t lane, bool names_spans)
      : QCPAbstractItem(plot), owner_(owner), lane_(lane), names_spans_(names_spans) {
    setLayer(QStringLiteral("overlay"));
    setClipToAxisRect(false);
  }
  double selectTest(const QPointF&, bool, QVariant*) const override { return -1.0; }

 protected:
  void draw(QCPPainter* painter) override {
    if (names_spans_)
      for (const PlotSpan& span : owner_.spans_) paintName(*painter, span);
    const Lane& lane = owner_.lanes_[lane_];
    const double middle = lane.rect->top() - 10.0;
    double x = lane.rect->left() + 1.0;
    x += word(*painter, x, middle, lane.description.title, theme::uiFont(8, QFont::DemiBold), theme::kText) +
         5;
    x += word(*painter, x, middle, lane.description.unit, theme::uiFont(7.6), theme::kFaint) + 14;
    const auto row = owner_.rowShown();
    for (const PlotSeries& series : lane.description.series) {
      if (series.name.isEmpty()) continue;
      const QFont font = theme::uiFont(7.6), numbers = theme::monoFont(7.6);
      const QString value = row ? valueText(owner_.valueOf(series, *row), lane.description) : kNoValue;
      const double width = 18 + QFontMetricsF(font).horizontalAdvance(series.name) + 6 +
                           QFontMetricsF(numbers).horizontalAdvance(QStringLiteral("+0000.000")) + 8;
      if (x + width > lane.rect->right() + 6) return;
      painter->setPen(QPen(series.color, series.width, series.style));
      painter->drawLine(QPointF(x, middle + 0.5), QPointF(x + 14, middle + 0.5));
      const double named = word(*painter, x + 18, middle, series.name, font, theme::kMuted);
      word(*painter, x + 18 + named + 6, middle, value, numbers, theme::kText);
      x += width;
    }
  }

 private:
  static double word(QCPPainter& painter, double x, double middle, const QString& text, const QFont& font,
                     const QColor& color) {
    painter.setFont(font);
    painter.setPen(color);
    const double width = QFontMetricsF(font).horizontalAdvance(text);
    painter.drawText(QRectF(x, middle - 9, width + 4, 18), Qt::AlignVCenter, text);
    return width;
  }

  void paintName(QCPPainter& painter, const PlotSpan& span) const {
    const QCPAxisRect& rect = *owner_.lanes_[lane_].rect;
    const QCPAxis& time = *rect.axis(QCPAxis::atBottom);
    const double left = std::max(double(rect.left()), time.coordToPixel(span.begin));
    const double right = std::min(double(rect.right()), time.coordToPixel(span.end));
    painter.setFont(theme::capsFont(6.2));
    const double width = painter.fontMetrics().horizontalAdvance(span.text.toUpper()) + 8;
    const bool moment = span.end <= span.begin;
    if (moment ? left + width > rect.right() : width > right - left) return;
    const QRectF box(left + 3, rect.bottom() - 15, width, 13);
    QColor ground = theme::kPanel;
    ground.setAlpha(215);
    painter.fillRect(box, ground);
    painter.setPen(span.color);
    painter.drawText(box, Qt::AlignCenter, span.text);
  }

  const TimePlots& owner_;
  std::size_t lane_;
  bool names_spans_;
};

TimePlots::TimePlots(const RigConfig& rig, const PlotPage& page, const TickHistory& history, TimeAxis& axis,
                     QWidget* parent)
    : QWidget(parent), rig_(rig), page_(page), history_(history), axis_(axis), plot_(new QCustomPlot) {
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
  Lane& lane = lanes_[index];
  lane.description = page_.lanes[index];
  lane.rect = new QCPAxisRect(plot_);
  const int row = static_cast<int>(index) / page_.columns, column = static_cast<int>(index) % page_.columns;
  const bool lowest = index + static_cast<std::size_t>(page_.columns) >= lanes_.size();
  plot_->plotLayout()->addElement(row, column, lane.rect);
  lane.rect->setAutoMargins(QCP::msNone);
  lane.rect->setMargins(QMargins(lane.description.levels.empty() ? 50 : 84, 21, 12, lowest ? 21 : 5));
  QCPAxis* time = lane.rect->axis(QCPAxis::atBottom);
  styleAxis(time);
  time->setTickLabels(lowest);
  time->setNumberFormat(QStringLiteral("f"));
  time->setNumberPrecision(0);
  styleValueAxis(lane);
  for (const PlotSeries& series : lane.description.series) {
    QCPGraph* graph = plot_->addGraph(time, lane.rect->axis(QCPAxis::atLeft));
    QPen pen(series.color, series.width, series.style);
    pen.setCapStyle(Qt::FlatCap);
    graph->setPen(pen);
    graph->setAntialiased(series.bit < 0);  // bars would show seams between their ticks
    lane.graphs.push_back(graph);
  }
  new SpanItem(plot_, lane.rect, *this);
  new HeadingItem(plot_, *this, index, lowest);
}

void TimePlots::styleValueAxis(Lane& lane) {
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
    value->setNumberPrecision(lane.description.decimals > 1 ? lane.description.decimals - 1
                                                            : lane.description.decimals);
    value->ticker()->setTickCount(3);
  }
}

void TimePlots::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange) takeTheme();
}

void TimePlots::takeTheme() {
  plot_->setBackground(theme::kPanel);
  for (Lane& lane : lanes_) {
    for (const auto type : {QCPAxis::atBottom, QCPAxis::atLeft}) colourAxis(lane.rect->axis(type));
    for (std::size_t i = 0; i < lane.graphs.size(); ++i) {
      PlotSeries& series = lane.description.series[i];
      series.color = theme::translated(series.color);
      QPen pen = lane.graphs[i]->pen();
      pen.setColor(series.color);
      lane.graphs[i]->setPen(pen);
    }
  }
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

double TimePlots::valueOf(const PlotSeries& series, std::int64_t row) const {
  const double value = history_.value(row, series.column);
  if (series.bit < 0) return value * series.scale;
  const bool set = (static_cast<std::uint32_t>(value) >> series.bit & 1U) != 0;
  return set ? series.level : kNothing;
}

void TimePlots::fill(Lane& lane, std::int64_t begin, std::int64_t end, std::int64_t step) {
  const double row_height =
      lane.rect->height() / std::max(1.0, lane.rect->axis(QCPAxis::atLeft)->range().size());
  for (std::size_t i = 0; i < lane.graphs.size(); ++i) {
    const PlotSeries& series = lane.description.series[i];
    QVector<QCPGraphData> points;
    points.reserve(static_cast<int>((end - begin) / step) + 2);
    for (std::int64_t row = begin; row < end; row += step) {
      const double value = valueOf(series, row);
      const bool drawable = !lane.description.logarithmic || value > kLowestLogarithm;
      points.append(QCPGraphData(history_.time(row), drawable ? value : kNothing));
    }
    lane.graphs[i]->data()->set(points, true);
    if (series.bit < 0) continue;
    QPen pen = lane.graphs[i]->pen();
    pen.setWidthF(std::clamp(0.62 * row_height, 2.0, 12.0));
    lane.graphs[i]->setPen(pen);
  }
}

void TimePlots::fitLogarithm(Lane& lane) {
  double low = std::numeric_limits<double>::max(), high = 0.0;
  for (const QCPGraph* graph : lane.graphs) {
    bool found = false;
    const QCPRange range = graph->getValueRange(found, QCP::sdPositive);
    if (!found) continue;
    low = std::min(low, range.lower);
    high = std::max(high, range.upper);
  }
  if (high <= 0.0) low = high = 1.0;
  const double lowest = std::floor(std::log10(low)), highest = std::ceil(std::log10(high));
  lane.rect->axis(QCPAxis::atLeft)
      ->setRange(std::pow(10.0, lowest), std::pow(10.0, std::max(highest, lowest + 2.0)));
}

void TimePlots::fitRange(Lane& lane) {
  const PlotLane& description = lane.description;
  QCPAxis* axis = lane.rect->axis(QCPAxis::atLeft);
  if (!description.levels.empty()) {
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    for (const PlotSeries& series : description.series) {
      low = std::min(low, series.level);
      high = std::max(high, series.level);
    }
    return axis->setRange(low - 0.8, high + 0.8);
  }
  if (description.logarithmic) return fitLogarithm(lane);
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
  for (const QCPGraph* graph : lane.graphs) {
    bool found = false;
    const QCPRange range = graph->getValueRange(found);
    if (!found) continue;
    low = std::min(low, range.lower);
    high = std::max(high, range.upper);
  }
  if (low > high) low = high = 0.0;
  // Whole steps, so that the axis does not tremble with the noise.
  const double step = 0.5 * description.smallest_span;
  const double pad = std::max(0.15 * (high - low), 0.2 * step);
  low = step * std::floor((low - pad) / step);
  if (description.one_sided) low = 0.0;
  high = step * std::ceil((high + pad) / step);
  const double margin = 0.01 * (high - low);  // or the outermost labels fall off the axis
  axis->setRange(low - margin, std::max(high, low + description.smallest_span) + margin);
}

void TimePlots::findSpans(std::int64_t begin, std::int64_t end, std::int64_t step) {
  spans_.clear();
  const auto scan = [&](int column, const QColor& color, const QString& text) {
    bool open = false;
    for (std::int64_t row = begin; row < end; row += step) {
      const bool on = history_.value(row, column) > 0.5;
      if (on && !open) spans_.push_back({history_.time(row), history_.time(row), color, text});
      if (on) spans_.back().end = history_.time(row) + 1e-3;
      open = on;
    }
  };
  for (int camera = 0; camera < history_.cameras(); ++camera) {
    const QString name = QString::fromStdString(rig_.cameras[static_cast<std::size_t>(camera)].name);
    const QColor color = theme::cameraColor(camera);
    scan(history_.column(camera, CameraColumn::kCovered), color, tr("%1 covered").arg(name));
    scan(history_.column(camera, CameraColumn::kTampered), color, tr("%1 disturbed").arg(name));
    const int knocks = history_.column(camera, CameraColumn::kKnocks);
    for (std::int64_t row = begin + step; row < end; row += step)
      if (history_.value(row, knocks) > history_.value(row - step, knocks))
        spans_.push_back({history_.time(row), history_.time(row), color, tr("%1 knocked").arg(name)});
  }
  scan(TickHistory::column(FlightColumn::kGust), theme::kActive, tr("gust"));
}

std::optional<std::int64_t> TimePlots::rowShown() const {
  if (history_.end() == history_.first()) return std::nullopt;
  const double time = hovered_.value_or(axis_.end());
  return std::clamp(history_.rowAt(time), history_.first(), history_.end() - 1);
}

void TimePlots::redraw() {
  if (lanes_.empty()) return;
  std::int64_t begin = history_.rowAt(axis_.begin()), end = history_.rowAt(axis_.end() + 1e-6);
  const std::int64_t step = (end - begin) / kShownPoints + 1;
  // The same rows whatever is newest, or the lines would shimmer.
  begin = std::max(history_.first(), begin / step * step);
  findSpans(begin, end, step);
  for (Lane& lane : lanes_) {
    fill(lane, begin, end, step);
    lane.rect->axis(QCPAxis::atBottom)->setRange(axis_.begin(), axis_.end());
    fitRange(lane);
  }
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

double TimePlots::timeAt(const QPointF& position) const {
  for (const Lane& lane : lanes_)
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
      hovered_ = timeAt(position);
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
      hovered_.reset();
      plot_->replot(QCustomPlot::rpQueuedReplot);
      return false;
    default:
      return QWidget::eventFilter(watched, event);
  }
}

void TimePlots::contextMenuEvent(QContextMenuEvent* event) {
  if (lanes_.empty()) return;
  QMenu menu;
  for (const char* suffix : {"png", "pdf", "csv"})
    menu.addAction(tr("Save as %1\u2026").arg(QString::fromLatin1(suffix).toUpper()), this,
                   [this, suffix] { askAndSave(QString::fromLatin1(suffix)); });
  menu.exec(event->globalPos());
}

void TimePlots::askAndSave(const QString& suffix) {
  const auto save_to = [this](const QString& path) {
    if (!save(path))
      openNotice(this, tr("Save the plots"), tr("%1 cannot be written. Choose another folder.").arg(path));
  };
  askWhereToSave(this, tr("Save the plots"),
                 QStringLiteral("helical-%1.%2").arg(page_.name.toLower(), suffix),
                 QStringLiteral("*.%1").arg(suffix), save_to);
}

bool TimePlots::save(const QString& path) {
  if (path.endsWith(QStringLiteral(".csv"), Qt::CaseInsensitive)) return writeCsv(path);
  plot_->replot(QCustomPlot::rpImmediateRefresh);
  if (path.endsWith(QStringLiteral(".pdf"), Qt::CaseInsensitive))
    return plot_->savePdf(path, 0, 0, QCP::epNoCosmetic, QStringLiteral("Helical"), page_.name);
  return plot_->savePng(path, 0, 0, 2.0);
}

bool TimePlots::writeCsv(const QString& path) const {
  QFile file(path);
  if (!file.open(QIODevice::WriteOnly | QIODevice::Text)) return false;
  QTextStream out(&file);
  out << "time_s";
  for (const Lane& lane : lanes_)
    for (const PlotSeries& series : lane.description.series) {
      QString name = lane.description.title + QLatin1Char(' ') + series.name;
      if (series.bit >= 0) name += QStringLiteral("row %1").arg(series.level);
      if (!lane.description.unit.isEmpty()) name += QStringLiteral(" [%1]").arg(lane.description.unit);
      out << ",\"" << name.simplified() << '"';
    }
  out << '\n';
  const std::int64_t end = history_.rowAt(axis_.end() + 1e-6);
  for (std::int64_t row = history_.rowAt(axis_.begin()); row < end; ++row) {
    out << QString::number(history_.time(row), 'f', 6);
    for (const Lane& lane : lanes_)
      for (const PlotSeries& series : lane.description.series) {
        const double value = valueOf(series, row);
        out << ',';
        if (series.bit >= 0)
          out << (std::isfinite(value) ? 1 : 0);
        else if (std::isfinite(value))
          out << value;
      }
    out << '\n';
  }
  out.flush();
  return file.error() == QFileDevice::NoError && out.status() == QTextStream::Ok;
}

int TimePlots::pointCount(int lane, int series) const {
  const QCPGraph* graph = lanes_[static_cast<std::size_t>(lane)].graphs[static_cast<std::size_t>(series)];
  return static_cast<int>(
      std::count_if(graph->data()->constBegin(), graph->data()->constEnd(),
                    [](const QCPGraphData& point) { return std::isfinite(point.value); }));
}

}  // namespace helical
