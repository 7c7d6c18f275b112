#include "ui/latency_plot.h"

#include <QContextMenuEvent>
#include <QPainter>
#include <QTextStream>
#include <algorithm>
#include <cmath>

#include "ui/format.h"
#include "ui/plot_saving.h"
#include "ui/theme.h"

namespace helical {
namespace {

constexpr int kLeft = 50, kRight = 14, kTop = 26, kBottom = 24;
constexpr int kLegendWidth = 300;
constexpr auto kBins = static_cast<std::size_t>(LatencyPlot::kLongestMs / LatencyPlot::kBinMs);

double percentile(const LatencyPlot::Histogram& histogram, double fraction) {
  int seen = 0;
  for (std::size_t i = 0; i < histogram.bins.size(); ++i) {
    seen += histogram.bins[i];
    if (seen >= fraction * histogram.count) return (static_cast<double>(i) + 0.5) * LatencyPlot::kBinMs;
  }
  return LatencyPlot::kLongestMs;
}

}  // namespace

LatencyPlot::LatencyPlot(const RigConfig& rig, const TickHistory& history, QWidget* parent)
    : QWidget(parent),
      rig_(rig),
      history_(history),
      histograms_(static_cast<std::size_t>(history.cameras())) {
  setAccessibleName(tr("Latency histogram"));
  setToolTip(tr("From mid-exposure to the use of a frame on the flight thread, over the shown time"));
}

void LatencyPlot::show(double begin, double end) {
  const std::int64_t first = history_.rowAt(begin), last = history_.rowAt(end + 1e-6);
  for (int camera = 0; camera < history_.cameras(); ++camera) {
    Histogram& histogram = histograms_[static_cast<std::size_t>(camera)];
    histogram = {std::vector<int>(kBins, 0), 0, 0.0, 0.0};
    const int column = history_.column(camera, CameraColumn::kLatency);
    for (std::int64_t row = first; row < last; ++row) {
      const double latency = history_.value(row, column);
      if (!std::isfinite(latency)) continue;
      ++histogram.bins[std::min(kBins - 1, static_cast<std::size_t>(std::max(0.0, latency / kBinMs)))];
      ++histogram.count;
    }
    if (histogram.count == 0) continue;
    histogram.median_ms = percentile(histogram, 0.50);
    histogram.p99_ms = percentile(histogram, 0.99);
  }
  update();
}

int LatencyPlot::shownBins() const {
  std::size_t last = 20;
  for (const Histogram& histogram : histograms_)
    for (std::size_t i = 0; i < histogram.bins.size(); ++i)
      if (histogram.bins[i] > 0) last = std::max(last, i + 3);
  return static_cast<int>(std::min(last, kBins));
}

void LatencyPlot::contextMenuEvent(QContextMenuEvent* event) {
  offerToSave(this, event->globalPos(), QStringLiteral("latency"), [this](const QString& path) { return save(path); });
}

bool LatencyPlot::save(const QString& path) {
  return savePlot(*this, path, [this] { return table(); });
}

QString LatencyPlot::table() const {
  QString text = QStringLiteral("from_ms");
  QTextStream out(&text, QIODevice::Append);
  for (const CameraConfig& camera : rig_.cameras)
    out << ",\"" << QString::fromStdString(camera.name) << " [frames]\"";
  out << '\n';
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    out << static_cast<double>(bin) * kBinMs;
    for (const Histogram& histogram : histograms_) out << ',' << (histogram.count > 0 ? histogram.bins[bin] : 0);
    out << '\n';
  }
  out.flush();
  return text;
}

void LatencyPlot::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), theme::kPanel);
  const QRectF area(kLeft, kTop, width() - kLeft - kRight - kLegendWidth, height() - kTop - kBottom);
  painter.setFont(theme::uiFont(8, QFont::DemiBold));
  painter.setPen(theme::kText);
  painter.drawText(QRectF(kLeft, 4, area.width(), 18), Qt::AlignVCenter, tr("Latency of the frames"));
  const int bins = shownBins();
  double most = 0.0;
  for (const Histogram& histogram : histograms_)
    for (const int count : histogram.bins)
      if (histogram.count > 0) most = std::max(most, static_cast<double>(count) / histogram.count);
  if (most <= 0.0) {
    painter.setPen(theme::kMuted);
    painter.drawText(area, Qt::AlignCenter, tr("No frames in the shown time"));
    return;
  }
  painter.setFont(theme::monoFont(7.4));
  for (int i = 0; i <= 4; ++i) {
    const double y = area.bottom() - i * area.height() / 4.0;
    painter.setPen(i == 0 ? theme::kLine : theme::kGrid);
    painter.drawLine(QPointF(area.left(), y), QPointF(area.right(), y));
    painter.setPen(theme::kMuted);
    painter.drawText(QRectF(0, y - 8, kLeft - 6, 16), Qt::AlignVCenter | Qt::AlignRight,
                     plainNumber(100.0 * most * i / 4.0, 0) + QLatin1String(" %"));
  }
  for (int i = 0; i <= 5; ++i)
    painter.drawText(QRectF(area.left() + i * area.width() / 5.0 - 30, area.bottom() + 4, 60, 16),
                     Qt::AlignCenter,
                     plainNumber(i * bins * kBinMs / 5.0, 1) + (i == 5 ? QStringLiteral(" ms") : QString()));
  double y = kTop;
  for (std::size_t camera = 0; camera < histograms_.size(); ++camera) {
    const Histogram& histogram = histograms_[camera];
    const QColor color = theme::cameraColor(static_cast<int>(camera));
    if (histogram.count > 0) {
      QPolygonF outline{QPointF(area.left(), area.bottom())};
      for (int i = 0; i < bins; ++i) {
        const double share =
            static_cast<double>(histogram.bins[static_cast<std::size_t>(i)]) / histogram.count;
        const double top = area.bottom() - area.height() * share / most;
        outline << QPointF(area.left() + i * area.width() / bins, top)
                << QPointF(area.left() + (i + 1) * area.width() / bins, top);
      }
      outline << QPointF(area.right(), area.bottom());
      QColor faint = color;
      faint.setAlpha(40);
      painter.setBrush(faint);
      painter.setPen(QPen(color, 1.3));
      painter.drawPolygon(outline);
    }
    if (y > height() - 20) continue;
    painter.setFont(theme::uiFont(8));
    painter.setPen(color);
    const double x = area.right() + 20;
    painter.drawText(QRectF(x, y, 96, 18), Qt::AlignVCenter,
                     QString::fromStdString(rig_.cameras[camera].name));
    painter.setFont(theme::monoFont(7.8));
    painter.setPen(theme::kText);
    painter.drawText(QRectF(x + 96, y, kLegendWidth - 110, 18), Qt::AlignVCenter,
                     histogram.count > 0
                         ? tr("median %1  99 % %2 ms")
                               .arg(plainNumber(histogram.median_ms, 1), plainNumber(histogram.p99_ms, 1))
                         : kNoValue);
    y += 19;
  }
}

}  // namespace helical
