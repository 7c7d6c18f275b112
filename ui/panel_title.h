#pragma once

#include <QColor>
#include <QHBoxLayout>
#include <QString>
#include <QWidget>

namespace helical {

/// The title bar of a panel or camera pane: a coloured tick, the name in small capitals, a note in mono on
/// the right that gives way when there is no room, and buttons or badges after it.
class PanelTitle : public QWidget {
  Q_OBJECT

 public:
  explicit PanelTitle(const QString& name, const QColor& tick, QWidget* parent = nullptr);

  const QString& name() const { return name_; }
  /// Small word behind the name, as CALIBRATED; empty for none.
  void setBadge(const QString& badge, const QColor& color);
  const QString& badge() const { return badge_; }
  /// `brief` stands in when `full` does not fit.
  void setNote(const QString& full, const QString& brief = {});
  void addWidget(QWidget* widget);

  // A dock lays its title bar out by these, not by a fixed height.
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  /// A dot where the word does not fit. Returns where the next text may begin.
  int paintBadge(QPainter& painter, int left, int right) const;

  QString name_;
  QColor tick_;
  QString badge_;
  QColor badge_color_;
  QString note_;
  QString brief_note_;
  QHBoxLayout* layout_;
};

}  // namespace helical
