#pragma once

#include <QObject>

namespace helical {

/// Space presses the button that has the focus, in all windows, before it is anybody's shortcut.
class ButtonKeys : public QObject {
 public:
  explicit ButtonKeys(QObject* parent);

  bool eventFilter(QObject* watched, QEvent* event) override;
};

}  // namespace helical
