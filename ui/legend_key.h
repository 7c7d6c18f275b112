#pragma once

#include <QColor>
#include <QWidget>

namespace helical {

/// One entry of a plot's legend: a piece of line and its meaning.
class LegendKey : public QWidget {
  Q_OBJECT

 public:
  LegendKey(const QString& text, const QColor& color, Qt::PenStyle style, QWidget* parent = nullptr);
  QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QString text_;
  QColor color_;
  Qt::PenStyle style_;
};

}  // namespace helical
