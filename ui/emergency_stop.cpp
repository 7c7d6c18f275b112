#include "ui/emergency_stop.h"

#include <QCoreApplication>
#include <QKeyEvent>

namespace helical {

EmergencyStop::EmergencyStop(QObject* parent) : QObject(parent) {
  QCoreApplication::instance()->installEventFilter(this);
}

bool EmergencyStop::eventFilter(QObject*, QEvent* event) {
  // The override comes first and may be accepted by a text field; stopping twice does no harm.
  if ((event->type() == QEvent::ShortcutOverride || event->type() == QEvent::KeyPress) &&
      static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape)
    Q_EMIT pressed();
  return false;
}

}  // namespace helical
