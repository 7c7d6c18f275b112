#include "ui/emergency_stop.h"

#include <QCoreApplication>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QWidget>

namespace helical {

EmergencyStop::EmergencyStop(QWidget* button, QObject* parent) : QObject(parent), button_(button) {
  QCoreApplication::instance()->installEventFilter(this);
}

bool EmergencyStop::onButton(const QMouseEvent& event) const {
  if (button_.isNull() || !button_->isVisible() || button_->window()->isMinimized()) return false;
  return button_->rect().contains(button_->mapFromGlobal(event.globalPosition().toPoint()));
}

bool EmergencyStop::eventFilter(QObject*, QEvent* event) {
  // The override comes first and may be accepted by a text field; stopping twice does no harm.
  switch (event->type()) {
    case QEvent::ShortcutOverride:
    case QEvent::KeyPress:
      if (static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) Q_EMIT pressed();
      break;
    case QEvent::MouseButtonPress:
    case QEvent::MouseButtonDblClick:
      // Whoever got it: a popup takes every press for itself, wherever it is.
      if (onButton(*static_cast<QMouseEvent*>(event))) Q_EMIT pressed();
      break;
    default:
      break;
  }
  return false;
}

}  // namespace helical
