#include "ui/figures/figure_text.h"

#include <QFont>
#include <QFontMetricsF>
#include <QPainter>

#include "ui/figures/figure_style.h"

namespace helical::figures {
namespace {

/// Fonts have whole pixels, figures are drawn in mm: text is laid out in hundredths of them.
constexpr double kUnitsPerMillimetre = 100.0;

QFont figureFont() {
  QFont font(QStringList{"Inter", "Noto Sans", "DejaVu Sans"});
  font.setPixelSize(static_cast<int>(kFontSize * kUnitsPerMillimetre));
  font.setHintingPreference(QFont::PreferNoHinting);
  return font;
}

}  // namespace

double textWidth(const QString& text) {
  return QFontMetricsF(figureFont()).horizontalAdvance(text) / kUnitsPerMillimetre;
}

void drawText(QPainter& painter, const QPointF& anchor, Qt::Alignment alignment, const QString& text) {
  const QFont font = figureFont();
  const QFontMetricsF metrics(font);
  const double width = metrics.horizontalAdvance(text);
  QPointF baseline(0.0, 0.0);
  if (alignment & Qt::AlignHCenter) baseline.rx() = -0.5 * width;
  if (alignment & Qt::AlignRight) baseline.rx() = -width;
  if (alignment & Qt::AlignVCenter) baseline.ry() = 0.5 * metrics.capHeight();
  if (alignment & Qt::AlignTop) baseline.ry() = metrics.capHeight();
  painter.save();
  painter.translate(anchor);
  painter.scale(1.0 / kUnitsPerMillimetre, 1.0 / kUnitsPerMillimetre);
  painter.setFont(font);
  painter.drawText(baseline, text);
  painter.restore();
}

void drawTextUpwards(QPainter& painter, const QPointF& anchor, const QString& text) {
  painter.save();
  painter.translate(anchor);
  painter.rotate(-90.0);
  drawText(painter, {0.0, 0.0}, Qt::AlignCenter, text);
  painter.restore();
}

}  // namespace helical::figures
