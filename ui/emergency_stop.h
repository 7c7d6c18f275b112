#pragma once

#include <QObject>
#include <QPointer>

class QMouseEvent;
class QWidget;

namespace helical {

/// Sees every Esc of the application, and every press on the STOP button, before any dialog, menu, popup or
/// drag does. The event then goes its usual way, so that a menu closes as well. Qt throws away presses on a
/// window that a modal dialog blocks: the window opens none (see open_dialog.h).
class EmergencyStop : public QObject {
  Q_OBJECT

 public:
  /// `button` may be missing.
  explicit EmergencyStop(QWidget* button, QObject* parent = nullptr);

 Q_SIGNALS:
  void pressed();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  bool onButton(const QMouseEvent& event) const;

  QPointer<QWidget> button_;
};

}  // namespace helical
