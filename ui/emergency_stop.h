#pragma once

#include <QObject>

namespace helical {

/// Sees every Esc of the application before any dialog, menu or drag does. The key then goes its usual way,
/// so that a dialog closes as well.
class EmergencyStop : public QObject {
  Q_OBJECT

 public:
  explicit EmergencyStop(QObject* parent = nullptr);

 Q_SIGNALS:
  void pressed();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
};

}  // namespace helical
