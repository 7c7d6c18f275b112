#pragma once

#include <Eigen/Core>
#include <QPointF>
#include <QRect>
#include <QSize>

namespace helical {

/// Which part of a camera's image is seen in a widget, and where: the whole image as large as fits, or a part
/// of it, zoomed and moved. A plain value. Pixel (0, 0) is the centre of the image's first pixel.
class PictureViewport {
 public:
  static constexpr double kLargestZoom = 16.0;

  void setSensor(QSize sensor) { sensor_ = sensor; }
  void setRoom(QSize room) { room_ = room; }

  /// Where the picture is in the widget: whole pixels.
  QRect area() const;
  /// Screen pixels per image pixel.
  double scale() const;
  double zoom() const { return zoom_; }
  bool zoomed() const { return zoom_ > 1.0; }

  QPointF toWidget(const Eigen::Vector2d& pixel) const;
  Eigen::Vector2d toImage(const QPointF& position) const;
  /// The part of the image that is seen [px, edges], inside of it.
  QRectF visible() const;

  /// Zooms by `factor`; what is under `position` stays there.
  void zoomAt(const QPointF& position, double factor);
  /// Moves the zoomed picture along with the mouse.
  void pan(const QPointF& by);
  void reset();

 private:
  void keepInside();

  QSize sensor_{4, 3};
  QSize room_{4, 3};
  double zoom_ = 1.0;
  Eigen::Vector2d corner_ = Eigen::Vector2d::Zero();  ///< of the visible part, top left edge [px]
};

}  // namespace helical
