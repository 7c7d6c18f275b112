#pragma once

#include <QImage>
#include <QWidget>

#include <optional>

#include "engine/cameras/frame.h"
#include "engine/pipeline/snapshot.h"
#include "ui/board_editor.h"
#include "ui/camera_track_history.h"
#include "ui/picture_scaler.h"
#include "ui/picture_viewport.h"

namespace helical {

/// The picture of one camera with its overlay. The wheel zooms, a drag moves the zoomed picture, a double
/// click shows all of it again. Without pictures (image-free sources) it draws the centroids on a dark ground
/// of the sensor's shape.
class CameraView : public QWidget {
  Q_OBJECT

 public:
  CameraView(const QColor& identity, QSize sensor, int marker_count, QWidget* parent = nullptr);

  void addTrack(const CameraTrack& track);
  /// Scales the picture to the widget once; painting only copies it.
  void setPicture(const CameraPicture& picture);
  void setMasks(const PictureMasks& masks);
  const PictureMasks& masks() const { return masks_; }
  void setTrailsShown(bool shown);
  /// The next click names the pixel whose colour is a marker's, instead of taking hold of something.
  void setPickingColour(bool picking);
  void setHidden(bool hidden);
  /// How many times larger than they are errors are drawn.
  void setMagnification(double magnification);

  /// The next drag draws a white board. Boards are dragged by their face and removed by the cross.
  void setBoardTool(BoardEditor::Tool tool);
  BoardEditor::Tool boardTool() const { return boards_.tool(); }
  void clearBoards();
  const WhiteBoards& boards() const { return boards_.boards(); }
  /// Where a pixel of the image is in this widget, and back.
  QPointF toWidget(const Eigen::Vector2d& pixel) const { return viewport_.toWidget(pixel); }
  Eigen::Vector2d toImage(const QPointF& position) const { return viewport_.toImage(position); }
  const PictureViewport& viewport() const { return viewport_; }
  /// How often it was painted.
  int paints() const { return paints_; }
  /// Small texts in the lower corners.
  void setCaptions(const QString& left, const QString& right);
  /// Small text in the upper left corner.
  void setExposure(const QString& text);

 Q_SIGNALS:
  void firstImagePainted();
  void boardsChanged(const helical::WhiteBoards& boards);
  void boardToolChanged();
  void colourPicked(const Eigen::Vector2d& pixel);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void paintMarks(QPainter& painter, const QRect& area) const;
  void updateCursor(const QPointF& position);
  void paintFrame(QPainter& painter, const QRectF& area) const;
  void paintCaptions(QPainter& painter, const QRectF& area) const;
  void paintBoards(QPainter& painter) const;
  void tellBoards();
  double handleReach() const;
  void paintHidden(QPainter& painter, const QRectF& area) const;

  QColor identity_;
  int marker_count_;
  PictureViewport viewport_;
  PictureMasks masks_;
  bool trails_ = true;
  bool picking_ = false;
  std::optional<QPointF> pan_from_;
  CameraTrackHistory history_;
  QImage image_;
  Observation observation_;
  bool observed_ = false;
  BoardEditor boards_;
  double magnification_ = 50.0;
  bool hidden_ = false;
  int paints_ = 0;
  bool had_image_ = false;
  QString left_caption_;
  QString right_caption_;
  QString exposure_;
};

}  // namespace helical
