#include "ui/legend_key.h"

#include <QFontMetrics>
#include <QPainter>

#include "ui/theme.h"

namespace helical {
namespace {

constexpr int kSample = 20;
constexpr int kGap = 6;

QFont keyFont() {
  return theme::uiFont(8);
}

}  // namespace

LegendKey::LegendKey(const QString& text, const QColor& color, Qt::PenStyle style, QWidget* parent)
    : QWidget(parent), text_(text), color_(color), style_(style) {
  setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
}

QSize LegendKey::sizeHint() const {
  return {kSample + kGap + QFontMetrics(keyFont()).horizontalAdvance(text_) + 10, 18};
}

void LegendKey::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const double middle = height() / 2.0 + 0.5;
  painter.setPen(QPen(color_, 1.6, style_));
  painter.drawLine(QPointF(0, middle), QPointF(kSample, middle));
  painter.setFont(keyFont());
  painter.setPen(theme::kMuted);
  painter.drawText(rect().adjusted(kSample + kGap, 0, 0, 0), Qt::AlignVCenter, text_);
}

}  // namespace helical
