#include "ui/panel_title.h"

#include <QEvent>
#include <QFontMetrics>
#include <QPainter>

#include "ui/theme.h"

namespace helical {
namespace {

constexpr int kHeight = 26;
constexpr int kTextLeft = 18;
constexpr int kGap = 10;

}  // namespace

PanelTitle::PanelTitle(const QString& name, const QColor& tick, QWidget* parent)
    : QWidget(parent), name_(name), tick_(tick), layout_(new QHBoxLayout(this)) {
  layout_->setContentsMargins(0, 0, 5, 0);
  layout_->setSpacing(4);
  layout_->addStretch(1);
  setFixedHeight(kHeight);
}

void PanelTitle::setBadge(const QString& badge, const QColor& color) {
  if (badge == badge_ && color == badge_color_) return;
  badge_ = badge;
  badge_color_ = color;
  update();
}

void PanelTitle::setNote(const QString& full, const QString& brief) {
  if (full == note_ && brief == brief_note_) return;
  note_ = full;
  brief_note_ = brief;
  update();
}

void PanelTitle::addWidget(QWidget* widget) {
  layout_->addWidget(widget);
}

void PanelTitle::changeEvent(QEvent* event) {
  if (event->type() != QEvent::PaletteChange) return;
  tick_ = theme::translated(tick_);
  badge_color_ = theme::translated(badge_color_);
}

QSize PanelTitle::sizeHint() const {
  return {120, kHeight};
}
QSize PanelTitle::minimumSizeHint() const {
  return {60, kHeight};
}

int PanelTitle::paintBadge(QPainter& painter, int left, int right) const {
  if (badge_.isEmpty()) return left;
  painter.setFont(theme::capsFont(6.2, QFont::Bold));
  const int width = painter.fontMetrics().horizontalAdvance(badge_.toUpper()) + 11;
  if (left + width > right) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(badge_color_);
    painter.drawEllipse(QPointF(left + 4, kHeight / 2.0), 3.5, 3.5);
    return left + 8 + kGap;
  }
  const QRectF frame(left + 0.5, 6.5, width, 13);
  QColor fill = badge_color_;
  fill.setAlpha(34);
  QColor border = badge_color_;
  border.setAlpha(110);
  painter.setPen(border);
  painter.setBrush(fill);
  painter.drawRoundedRect(frame, 3, 3);
  painter.setPen(badge_color_);
  painter.drawText(frame.translated(0.5, 0), Qt::AlignCenter, badge_);
  return left + width + kGap;
}

void PanelTitle::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(theme::kLine);
  painter.setBrush(theme::kTitle);
  painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, 5), 4, 4);
  painter.drawLine(QPointF(0, kHeight - 0.5), QPointF(width(), kHeight - 0.5));
  painter.setPen(Qt::NoPen);
  painter.setBrush(tick_);
  painter.drawRoundedRect(QRectF(8, 8, 3, 10), 1.5, 1.5);

  int right = width() - kGap;
  for (int i = 0; i < layout_->count(); ++i)
    if (const QWidget* widget = layout_->itemAt(i)->widget(); widget != nullptr && !widget->isHidden())
      right = std::min(right, widget->x() - 8);

  painter.setFont(theme::capsFont(7.6));
  const QFontMetrics metrics(painter.font());
  // Elide what the capitals will show, or the text comes out wider than was measured.
  const QString shown = metrics.elidedText(name_.toUpper(), Qt::ElideRight, right - kTextLeft);
  painter.setPen(theme::kText);
  painter.drawText(QRect(kTextLeft, 0, right - kTextLeft, kHeight), Qt::AlignVCenter, shown);
  const int left = paintBadge(painter, kTextLeft + metrics.horizontalAdvance(shown) + kGap, right);

  painter.setFont(theme::monoFont(7.8));
  painter.setPen(theme::kMuted);
  for (const QString& note : {note_, brief_note_}) {
    if (painter.fontMetrics().horizontalAdvance(note) > right - left) continue;
    painter.drawText(QRect(left, 0, right - left, kHeight), Qt::AlignVCenter | Qt::AlignRight, note);
    break;
  }
}

}  // namespace helical
