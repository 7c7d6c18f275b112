#pragma once

#include <QColor>
#include <QWidget>

namespace helical {

/// A small framed value of the top bar: dot, name in capitals, value in mono. Its width is that of the
/// longest value it may show, so that the bar does not jump.
class StatusChip : public QWidget {
  Q_OBJECT

 public:
  StatusChip(const QString& name, const QString& longest_value, QWidget* parent = nullptr);

  void set(const QString& value, const QColor& color);
  const QString& value() const { return value_; }
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override { return sizeHint(); }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QString name_;
  QString value_;
  QColor color_;
  int name_width_;
  int value_width_;
};

}  // namespace helical
