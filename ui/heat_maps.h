#pragma once

#include <QWidget>

#include "ui/image_heat.h"

namespace helical {

/// One camera's image as two small maps: how often used markers were seen in each part, and how far off they
/// were there.
class HeatMaps : public QWidget {
  Q_OBJECT

 public:
  HeatMaps(const QString& camera_name, QSize sensor, QWidget* parent = nullptr);

  void add(const CameraTrack& track, int marker_count) { heat_.add(track, marker_count); }
  void clear();
  const ImageHeat& heat() const { return heat_; }
  /// As picture, page or table, by the file's suffix; false if it cannot be written.
  bool save(const QString& path);

  QSize sizeHint() const override { return {240, 104}; }
  QSize minimumSizeHint() const override { return {200, 96}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;

 private:
  QString table() const;

  QString camera_name_;
  ImageHeat heat_;
};

}  // namespace helical
