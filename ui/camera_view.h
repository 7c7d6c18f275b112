#pragma once

#include <QImage>
#include <QWidget>

#include "engine/cameras/frame.h"
#include "engine/pipeline/snapshot.h"
#include "ui/camera_track_history.h"

namespace helical {

/// The picture of one camera with its overlay. Without pictures (image-free sources) it draws the centroids
/// on a dark ground of the sensor's shape.
class CameraView : public QWidget {
  Q_OBJECT

 public:
  CameraView(const QColor& identity, QSize sensor, int marker_count, QWidget* parent = nullptr);

  void addTrack(const CameraTrack& track);
  /// Scales the picture to the widget once; painting only copies it.
  void setPicture(const CameraPicture& picture);
  void setHidden(bool hidden);
  /// Small texts in the lower corners.
  void setCaptions(const QString& left, const QString& right);

 Q_SIGNALS:
  void firstImagePainted();

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void scalePicture(const CameraPicture& picture);
  QRect pictureArea() const;
  void paintFrame(QPainter& painter, const QRectF& area) const;
  void paintCaptions(QPainter& painter, const QRectF& area) const;
  void paintHidden(QPainter& painter, const QRectF& area) const;

  QColor identity_;
  QSize sensor_;
  int marker_count_;
  CameraTrackHistory history_;
  QImage image_;
  Observation observation_;
  bool observed_ = false;
  bool hidden_ = false;
  bool painted_ = false;
  QString left_caption_;
  QString right_caption_;
};

}  // namespace helical
