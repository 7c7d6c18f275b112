#include "ui/picture_viewport.h"

#include <algorithm>

namespace helical {

QRect PictureViewport::area() const {
  // Whole pixels: the picture is then copied, not resampled, whenever it is painted.
  const QSize fitted = sensor_.scaled(room_, Qt::KeepAspectRatio);
  return {QPoint((room_.width() - fitted.width()) / 2, (room_.height() - fitted.height()) / 2), fitted};
}

double PictureViewport::scale() const {
  return zoom_ * std::max(1, area().width()) / std::max(1, sensor_.width());
}

QPointF PictureViewport::toWidget(const Eigen::Vector2d& pixel) const {
  return area().topLeft() +
         QPointF((pixel.x() + 0.5 - corner_.x()) * scale(), (pixel.y() + 0.5 - corner_.y()) * scale());
}

Eigen::Vector2d PictureViewport::toImage(const QPointF& position) const {
  const QPointF from = position - area().topLeft();
  return {from.x() / scale() + corner_.x() - 0.5, from.y() / scale() + corner_.y() - 0.5};
}

QRectF PictureViewport::visible() const {
  return {corner_.x(), corner_.y(), sensor_.width() / zoom_, sensor_.height() / zoom_};
}

void PictureViewport::zoomAt(const QPointF& position, double factor) {
  const Eigen::Vector2d fixed = toImage(position);
  zoom_ = std::clamp(zoom_ * factor, 1.0, kLargestZoom);
  corner_ += fixed - toImage(position);
  keepInside();
}

void PictureViewport::pan(const QPointF& by) {
  corner_ -= Eigen::Vector2d(by.x(), by.y()) / scale();
  keepInside();
}

void PictureViewport::reset() {
  zoom_ = 1.0;
  corner_.setZero();
}

void PictureViewport::keepInside() {
  const Eigen::Vector2d sensor(sensor_.width(), sensor_.height());
  corner_ = corner_.cwiseMax(0.0).cwiseMin(sensor * (1.0 - 1.0 / zoom_));
}

}  // namespace helical
