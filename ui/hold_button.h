#pragma once

#include <QElapsedTimer>
#include <QPushButton>
#include <QTimer>

namespace helical {

/// A button that means it only when it is held down, by mouse or by Space when it has the focus, until its
/// bar is full. Let go before, nothing happens.
class HoldButton : public QPushButton {
  Q_OBJECT

 public:
  static constexpr int kHoldMs = 1000;

  explicit HoldButton(const QString& text, QWidget* parent = nullptr);

  /// Off: an ordinary button.
  void setHoldNeeded(bool needed) { hold_needed_ = needed; }
  double progress() const;

 Q_SIGNALS:
  void held();

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void keyReleaseEvent(QKeyEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void beginHold();
  void endHold();
  void tick();

  bool hold_needed_ = true;
  QTimer timer_;
  QElapsedTimer since_;
};

}  // namespace helical
