#include "ui/status_chip.h"

#include <QFontMetrics>
#include <QPainter>

#include "ui/format.h"
#include "ui/theme.h"

namespace helical {
namespace {

constexpr int kHeight = 28;
constexpr int kNameLeft = 24;
constexpr int kGap = 13;

QFont nameFont() {
  return theme::capsFont(7.0);
}
QFont valueFont() {
  return theme::monoFont(8.8, QFont::Medium);
}

}  // namespace

StatusChip::StatusChip(const QString& name, const QString& longest_value, QWidget* parent)
    : QWidget(parent), name_(name), value_(kNoValue), color_(theme::kFaint) {
  name_width_ = QFontMetrics(nameFont()).horizontalAdvance(name.toUpper());
  value_width_ = QFontMetrics(valueFont()).horizontalAdvance(longest_value);
  setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
  setAccessibleName(name);
}

void StatusChip::set(const QString& value, const QColor& color) {
  if (value == value_ && color == color_) return;
  value_ = value;
  color_ = color;
  setAccessibleDescription(value);
  update();
}

QSize StatusChip::sizeHint() const {
  return {kNameLeft + name_width_ + kGap + value_width_ + 12, kHeight};
}

void StatusChip::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(theme::kLine);
  painter.setBrush(theme::kTitle);
  painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 4, 4);
  QColor glow = color_;
  glow.setAlpha(60);
  painter.setPen(Qt::NoPen);
  painter.setBrush(glow);
  painter.drawEllipse(QPointF(13, kHeight / 2.0), 6, 6);
  painter.setBrush(color_);
  painter.drawEllipse(QPointF(13, kHeight / 2.0), 3.3, 3.3);
  painter.setFont(nameFont());
  painter.setPen(theme::kMuted);
  painter.drawText(QRect(kNameLeft, 0, name_width_ + kGap, kHeight), Qt::AlignVCenter, name_);
  painter.setFont(valueFont());
  painter.setPen(theme::kText);
  painter.drawText(QRect(0, 0, width() - 12, kHeight), Qt::AlignVCenter | Qt::AlignRight, value_);
}

}  // namespace helical
