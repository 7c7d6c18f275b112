#include "ui/plot_items.h"

#include <qcustomplot.h>

#include <algorithm>
#include <cmath>

#include "ui/format.h"
#include "ui/theme.h"

namespace helical {
namespace {

constexpr int kSpanOpacity = 30, kMomentOpacity = 170;

bool isMoment(const PlotSpan& span) {
  return span.end <= span.begin;
}

QString valueText(double value, const PlotLane& lane) {
  if (!std::isfinite(value)) return kNoValue;
  return lane.one_sided ? plainNumber(value, lane.decimals) : signedNumber(value, lane.decimals);
}

/// Spans and the pointer's time, behind the lines.
class SpanItem final : public QCPAbstractItem {
 public:
  SpanItem(QCustomPlot* plot, const PlotReadout& readout, const DrawnLane& lane)
      : QCPAbstractItem(plot), readout_(readout), rect_(lane.rect) {
    setLayer(QStringLiteral("background"));
    setClipAxisRect(rect_);
    setClipToAxisRect(true);
  }
  double selectTest(const QPointF&, bool, QVariant*) const override { return -1.0; }

 protected:
  void draw(QCPPainter* painter) override {
    const QCPAxis* time = rect_->axis(QCPAxis::atBottom);
    for (const PlotSpan& span : readout_.spans) {
      const double left = time->coordToPixel(span.begin);
      const double right = std::max(left + 1.5, time->coordToPixel(span.end));
      QColor fill = span.color;
      fill.setAlpha(isMoment(span) ? kMomentOpacity : kSpanOpacity);
      painter->fillRect(QRectF(left, rect_->top(), right - left, rect_->height()), fill);
    }
    if (!readout_.hovered) return;
    painter->setPen(QPen(theme::kFaint, 1));
    const double x = time->coordToPixel(*readout_.hovered);
    painter->drawLine(QPointF(x, rect_->top()), QPointF(x, rect_->bottom()));
  }

 private:
  const PlotReadout& readout_;
  QCPAxisRect* rect_;
};

class HeadingItem final : public QCPAbstractItem {
 public:
  HeadingItem(QCustomPlot* plot, const PlotReadout& readout, const DrawnLane& lane, bool names_spans)
      : QCPAbstractItem(plot), readout_(readout), lane_(lane), names_spans_(names_spans) {
    setLayer(QStringLiteral("overlay"));
    setClipToAxisRect(false);
  }
  double selectTest(const QPointF&, bool, QVariant*) const override { return -1.0; }

 protected:
  void draw(QCPPainter* painter) override {
    if (names_spans_)
      for (const PlotSpan& span : readout_.spans) paintName(*painter, span);
    if (lane_.blank) paintNote(*painter);
    paintHeading(*painter);
  }

 private:
  void paintHeading(QCPPainter& painter) const {
    const double middle = lane_.rect->top() - 10.0;
    const PlotLane& lane = lane_.description;
    double x = lane_.rect->left() + 1.0;
    x += word(painter, x, middle, lane.title, theme::uiFont(8, QFont::DemiBold), theme::kText) + 5;
    x += word(painter, x, middle, lane.unit, theme::uiFont(7.6), theme::kFaint) + 14;
    const auto row = readout_.row();
    for (const PlotSeries& series : lane.series) {
      if (series.name.isEmpty()) continue;
      const QFont font = theme::uiFont(7.6), numbers = theme::monoFont(7.6);
      const QString value = row ? valueText(valueOf(series, readout_.history, *row), lane) : kNoValue;
      const double width = 18 + QFontMetricsF(font).horizontalAdvance(series.name) + 6 +
                           QFontMetricsF(numbers).horizontalAdvance(QStringLiteral("+0000.000")) + 8;
      if (x + width > lane_.rect->right() + 6) return;
      painter.setPen(QPen(series.color, series.width, series.style));
      painter.drawLine(QPointF(x, middle + 0.5), QPointF(x + 14, middle + 0.5));
      const double named = word(painter, x + 18, middle, series.name, font, theme::kMuted);
      word(painter, x + 18 + named + 6, middle, value, numbers, theme::kText);
      x += width;
    }
  }

  static double word(QCPPainter& painter, double x, double middle, const QString& text, const QFont& font,
                     const QColor& color) {
    painter.setFont(font);
    painter.setPen(color);
    const double width = QFontMetricsF(font).horizontalAdvance(text);
    painter.drawText(QRectF(x, middle - 9, width + 4, 18), Qt::AlignVCenter, text);
    return width;
  }

  void paintName(QCPPainter& painter, const PlotSpan& span) const {
    const QCPAxisRect& rect = *lane_.rect;
    const QCPAxis& time = *rect.axis(QCPAxis::atBottom);
    const double left = std::max(double(rect.left()), time.coordToPixel(span.begin));
    const double right = std::min(double(rect.right()), time.coordToPixel(span.end));
    painter.setFont(theme::capsFont(6.2));
    const double width = painter.fontMetrics().horizontalAdvance(span.text.toUpper()) + 8;
    if (isMoment(span) ? left + width > rect.right() : width > right - left) return;
    const QRectF box(left + 3, rect.bottom() - 15, width, 13);
    QColor ground = theme::kPanel;
    ground.setAlpha(215);
    painter.fillRect(box, ground);
    painter.setPen(span.color);
    painter.drawText(box, Qt::AlignCenter, span.text);
  }

  void paintNote(QCPPainter& painter) const {
    painter.setFont(theme::uiFont(8.4));
    painter.setPen(theme::kMuted);
    painter.drawText(QRectF(lane_.rect->rect()), Qt::AlignCenter | Qt::TextWordWrap, lane_.description.empty);
  }

  const PlotReadout& readout_;
  const DrawnLane& lane_;
  bool names_spans_;
};

}  // namespace

std::optional<std::int64_t> PlotReadout::row() const {
  if (history.end() == history.first()) return std::nullopt;
  return std::clamp(history.rowAt(hovered.value_or(axis.end())), history.first(), history.end() - 1);
}

void addItems(QCustomPlot& plot, const PlotReadout& readout, const DrawnLane& lane, bool names_spans) {
  new SpanItem(&plot, readout, lane);
  new HeadingItem(&plot, readout, lane, names_spans);
}

}  // namespace helical
