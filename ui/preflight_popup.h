#pragma once

#include <QFrame>

#include "ui/preflight.h"

namespace helical {

/// The pre-flight list as a sheet that hangs from the readiness word and closes at the next click elsewhere.
class PreflightPopup : public QFrame {
  Q_OBJECT

 public:
  explicit PreflightPopup(QWidget* parent);

  void show(const std::vector<PreflightItem>& items);
  /// Opens below `anchor`.
  void openBelow(const QWidget& anchor);

  const std::vector<PreflightItem>& items() const { return items_; }
  QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  std::vector<PreflightItem> items_;
};

}  // namespace helical
