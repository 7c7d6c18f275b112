#include "ui/camera_view.h"

#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>

#include "ui/camera_overlay.h"
#include "ui/theme.h"

namespace helical {
namespace {

constexpr double kHandle = 8.0;  // screen pixels: radius of a board's cross

}  // namespace

CameraView::CameraView(const QColor& identity, QSize sensor, int marker_count, QWidget* parent)
    : QWidget(parent), identity_(identity), sensor_(sensor), marker_count_(marker_count) {
  setAttribute(Qt::WA_OpaquePaintEvent);
  setMouseTracking(true);
}

void CameraView::addTrack(const CameraTrack& track) {
  history_.add(track);
  // With pictures the next picture repaints; without them the track is all there is to show.
  if (image_.isNull()) update();
}

void CameraView::setPicture(const CameraPicture& picture) {
  observation_ = picture.observation;
  observed_ = true;
  if (!picture.bgr.empty()) scalePicture(picture);
  update();
}

void CameraView::scalePicture(const CameraPicture& picture) {
  sensor_ = QSize(picture.width, picture.height);
  const QSize size = (QSizeF(pictureArea().size()) * devicePixelRatioF()).toSize().expandedTo(QSize(1, 1));
  if (image_.size() != size) image_ = QImage(size, QImage::Format_RGB32);
  image_.setDevicePixelRatio(devicePixelRatioF());
  const cv::Mat bgr(picture.height, picture.width, CV_8UC3, const_cast<std::uint8_t*>(picture.bgr.data()));
  cv::Mat target(size.height(), size.width(), CV_8UC4, image_.bits(),
                 static_cast<std::size_t>(image_.bytesPerLine()));
  cv::Mat scaled;
  cv::resize(bgr, scaled, target.size(), 0, 0, cv::INTER_LINEAR);
  cv::cvtColor(scaled, target, cv::COLOR_BGR2BGRA);
}

void CameraView::setHidden(bool hidden) {
  if (hidden == hidden_) return;
  hidden_ = hidden;
  update();
}

void CameraView::setMagnification(double magnification) {
  magnification_ = magnification;
  update();
}

QPointF CameraView::toWidget(const Eigen::Vector2d& pixel) const {
  const QRect area = pictureArea();
  const double scale = static_cast<double>(area.width()) / sensor_.width();
  return area.topLeft() + QPointF((pixel.x() + 0.5) * scale, (pixel.y() + 0.5) * scale);
}

Eigen::Vector2d CameraView::toImage(const QPointF& position) const {
  const QRect area = pictureArea();
  const double scale = static_cast<double>(area.width()) / sensor_.width();
  return {(position.x() - area.left()) / scale - 0.5, (position.y() - area.top()) / scale - 0.5};
}

double CameraView::handleReach() const {
  return kHandle * sensor_.width() / std::max(1, pictureArea().width());
}

void CameraView::setBoardTool(BoardEditor::Tool tool) {
  boards_.setTool(tool);
  setCursor(tool == BoardEditor::Tool::kNone ? Qt::ArrowCursor : Qt::CrossCursor);
  Q_EMIT boardToolChanged();
}

void CameraView::clearBoards() {
  boards_.clear();
  tellBoards();
}

void CameraView::tellBoards() {
  if (boards_.takeChange()) Q_EMIT boardsChanged(boards_.boards());
  update();
}

void CameraView::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || !boards_.press(toImage(event->position()), handleReach()))
    return QWidget::mousePressEvent(event);
  tellBoards();
}

void CameraView::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons() & Qt::LeftButton) {
    boards_.move(toImage(event->position()));
    return tellBoards();
  }
  if (boards_.tool() == BoardEditor::Tool::kNone)
    setCursor(boards_.wouldGrab(toImage(event->position()), handleReach()) ? Qt::OpenHandCursor
                                                                           : Qt::ArrowCursor);
}

void CameraView::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  const BoardEditor::Tool before = boards_.tool();
  boards_.release();
  tellBoards();
  if (boards_.tool() != before) setBoardTool(boards_.tool());
}

void CameraView::setCaptions(const QString& left, const QString& right) {
  if (left == left_caption_ && right == right_caption_) return;
  left_caption_ = left;
  right_caption_ = right;
  update();
}

QRect CameraView::pictureArea() const {
  // Whole pixels: the picture is then copied, not resampled, whenever it is painted.
  const QSize fitted = sensor_.scaled(size(), Qt::KeepAspectRatio);
  return {QPoint((width() - fitted.width()) / 2, (height() - fitted.height()) / 2), fitted};
}

void CameraView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), QColor(7, 9, 12));
  const QRect area = pictureArea();
  if (image_.isNull())
    painter.fillRect(area, QColor(13, 17, 22));
  else
    painter.drawImage(area, image_);

  painter.save();
  painter.setClipRect(area);
  painter.translate(area.topLeft());
  CameraOverlay overlay;
  overlay.track = observed_ ? history_.at(observation_.exposure) : history_.newest();
  overlay.observation = observed_ ? &observation_ : nullptr;
  overlay.marker_count = marker_count_;
  overlay.magnification = magnification_;
  paintOverlay(painter, overlay, static_cast<double>(area.width()) / sensor_.width());
  painter.restore();

  paintBoards(painter);
  if (hidden_) paintHidden(painter, area);
  paintFrame(painter, area);
  paintCaptions(painter, area);
  if (!painted_ && !image_.isNull()) {
    painted_ = true;
    Q_EMIT firstImagePainted();
  }
}

void CameraView::paintFrame(QPainter& painter, const QRectF& area) const {
  QColor color = identity_;
  color.setAlpha(hidden_ ? 70 : 170);
  painter.setPen(QPen(color, 1.6));
  const QRectF frame = area.adjusted(6, 6, -6, -6);
  const double length = 13;
  const std::array<QPointF, 4> corners{frame.topLeft(), frame.topRight(), frame.bottomRight(),
                                       frame.bottomLeft()};
  for (const QPointF& corner : corners) {
    const double dx = corner.x() < frame.center().x() ? length : -length;
    const double dy = corner.y() < frame.center().y() ? length : -length;
    painter.drawPolyline(QPolygonF{{corner + QPointF(dx, 0), corner, corner + QPointF(0, dy)}});
  }
}

void CameraView::paintCaptions(QPainter& painter, const QRectF& area) const {
  painter.setFont(theme::monoFont(7.6));
  const QFontMetrics metrics(painter.font());
  const QRectF line(area.left() + 14, area.bottom() - 27, area.width() - 28, 15);
  const auto paint = [&](const QString& text, double left) {
    const QRectF box(left, line.top(), metrics.horizontalAdvance(text), line.height());
    painter.fillRect(box.adjusted(-4, 0, 4, 0), QColor(8, 12, 16, 150));
    painter.setPen(QColor(205, 215, 226));
    painter.drawText(box, Qt::AlignVCenter, text);
  };
  if (!left_caption_.isEmpty()) paint(left_caption_, line.left());
  const int right_width = metrics.horizontalAdvance(right_caption_);
  const bool room = metrics.horizontalAdvance(left_caption_) + 12 + right_width <= line.width();
  if (!right_caption_.isEmpty() && room) paint(right_caption_, line.right() - right_width);
}

void CameraView::paintBoard(QPainter& painter, const WhiteBoard& board, bool draft) const {
  QPolygonF outline;
  for (int i = 0; i < board.count; ++i) outline << toWidget(board.corners[static_cast<std::size_t>(i)]);
  // The frames show the board themselves; without images nothing else would.
  const bool fill = draft || image_.isNull();
  painter.setBrush(fill ? QColor(235, 235, 235, draft ? 90 : 170) : QColor(Qt::transparent));
  painter.setPen(QPen(theme::kCaution, 1.4, draft ? Qt::DashLine : Qt::SolidLine));
  painter.drawPolygon(outline);
  if (draft) return;
  const QPointF center = toWidget(BoardEditor::handle(board));
  painter.setPen(QPen(QColor(8, 12, 16), 1));
  painter.setBrush(theme::kCaution);
  painter.drawEllipse(center, kHandle - 1.0, kHandle - 1.0);
  painter.setPen(QPen(QColor(8, 12, 16), 1.6));
  const double arm = 3.0;
  painter.drawLine(center + QPointF(-arm, -arm), center + QPointF(arm, arm));
  painter.drawLine(center + QPointF(-arm, arm), center + QPointF(arm, -arm));
}

void CameraView::paintBoards(QPainter& painter) const {
  const WhiteBoards& boards = boards_.boards();
  painter.setRenderHint(QPainter::Antialiasing);
  for (int i = 0; i < boards.count; ++i)
    paintBoard(painter, boards.boards[static_cast<std::size_t>(i)], false);
  if (boards_.draft().count >= 2) paintBoard(painter, boards_.draft(), true);
}

void CameraView::paintHidden(QPainter& painter, const QRectF& area) const {
  painter.fillRect(area, QColor(7, 9, 12, 165));
  painter.setFont(theme::capsFont(9));
  painter.setPen(theme::kCaution);
  painter.drawText(area, Qt::AlignCenter, tr("Hidden from the tracker"));
}

}  // namespace helical
