#pragma once

#include <QImage>
#include <QWidget>

#include "engine/cameras/frame.h"
#include "engine/pipeline/snapshot.h"
#include "ui/board_editor.h"
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
  /// How many times larger than they are errors are drawn.
  void setMagnification(double magnification);

  /// The next drag draws a white board. Boards are dragged by their face and removed by the cross.
  void setBoardTool(BoardEditor::Tool tool);
  BoardEditor::Tool boardTool() const { return boards_.tool(); }
  void clearBoards();
  const WhiteBoards& boards() const { return boards_.boards(); }
  /// Where a pixel of the image is in this widget, and back.
  QPointF toWidget(const Eigen::Vector2d& pixel) const;
  Eigen::Vector2d toImage(const QPointF& position) const;
  /// Small texts in the lower corners.
  void setCaptions(const QString& left, const QString& right);

 Q_SIGNALS:
  void firstImagePainted();
  void boardsChanged(const helical::WhiteBoards& boards);
  void boardToolChanged();

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;

 private:
  void scalePicture(const CameraPicture& picture);
  QRect pictureArea() const;
  void paintFrame(QPainter& painter, const QRectF& area) const;
  void paintCaptions(QPainter& painter, const QRectF& area) const;
  void paintBoards(QPainter& painter) const;
  void paintBoard(QPainter& painter, const WhiteBoard& board, bool draft) const;
  void tellBoards();
  double handleReach() const;
  void paintHidden(QPainter& painter, const QRectF& area) const;

  QColor identity_;
  QSize sensor_;
  int marker_count_;
  CameraTrackHistory history_;
  QImage image_;
  Observation observation_;
  bool observed_ = false;
  BoardEditor boards_;
  double magnification_ = 50.0;
  bool hidden_ = false;
  bool painted_ = false;
  QString left_caption_;
  QString right_caption_;
};

}  // namespace helical
