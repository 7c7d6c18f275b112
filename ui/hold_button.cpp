#include "ui/hold_button.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>

#include "ui/theme.h"

namespace helical {

HoldButton::HoldButton(const QString& text, QWidget* parent) : QPushButton(text, parent) {
  timer_.setInterval(16);
  connect(&timer_, &QTimer::timeout, this, &HoldButton::tick);
}

void HoldButton::beginHold() {
  if (!hold_needed_ || !isEnabled() || timer_.isActive()) return;
  since_.start();
  timer_.start();
  setDown(true);
}

void HoldButton::endHold() {
  if (!timer_.isActive()) return;
  timer_.stop();
  setDown(false);  // what is up again when the mouse is let go is no click
  update();
}

double HoldButton::progress() const {
  return timer_.isActive() ? std::min(1.0, static_cast<double>(since_.elapsed()) / kHoldMs) : 0.0;
}

void HoldButton::tick() {
  update();
  if (since_.elapsed() < kHoldMs) return;
  endHold();
  Q_EMIT held();
}

void HoldButton::paintEvent(QPaintEvent* event) {
  QPushButton::paintEvent(event);
  if (!timer_.isActive()) return;
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QRectF bar(4.0, height() - 6.0, (width() - 8.0) * progress(), 3.0);
  painter.setPen(Qt::NoPen);
  painter.setBrush(theme::kCaution);
  painter.drawRoundedRect(bar, 1.5, 1.5);
}

void HoldButton::mousePressEvent(QMouseEvent* event) {
  QPushButton::mousePressEvent(event);
  if (event->button() == Qt::LeftButton) beginHold();
}

void HoldButton::mouseReleaseEvent(QMouseEvent* event) {
  endHold();
  QPushButton::mouseReleaseEvent(event);
}

void HoldButton::mouseMoveEvent(QMouseEvent* event) {
  // Slipping off is letting go.
  if (timer_.isActive() && !rect().contains(event->position().toPoint())) endHold();
}

void HoldButton::keyPressEvent(QKeyEvent* event) {
  if (event->key() != Qt::Key_Space || !hold_needed_) return QPushButton::keyPressEvent(event);
  if (!event->isAutoRepeat()) beginHold();
}

void HoldButton::keyReleaseEvent(QKeyEvent* event) {
  // Also when it stopped being needed while the key was down.
  if (event->key() != Qt::Key_Space || !timer_.isActive()) {
    if (isDown()) QPushButton::keyReleaseEvent(event);
    return;
  }
  if (!event->isAutoRepeat()) endHold();
}

void HoldButton::focusOutEvent(QFocusEvent* event) {
  endHold();
  QPushButton::focusOutEvent(event);
}

void HoldButton::changeEvent(QEvent* event) {
  if (event->type() == QEvent::EnabledChange && !isEnabled()) endHold();
  QPushButton::changeEvent(event);
}

}  // namespace helical
