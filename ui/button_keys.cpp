#include "ui/button_keys.h"

#include <QAbstractButton>
#include <QComboBox>
#include <QCoreApplication>
#include <QKeyEvent>

namespace helical {

ButtonKeys::ButtonKeys(QObject* parent) : QObject(parent) {
  QCoreApplication::instance()->installEventFilter(this);
}

bool ButtonKeys::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::ShortcutOverride || static_cast<QKeyEvent*>(event)->key() != Qt::Key_Space)
    return false;
  if (qobject_cast<QAbstractButton*>(watched) == nullptr && qobject_cast<QComboBox*>(watched) == nullptr)
    return false;
  event->accept();  // what is accepted here goes to the widget as a key
  return true;
}

}  // namespace helical
