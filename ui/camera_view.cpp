#include "ui/camera_view.h"

#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>
#include <algorithm>
#include <array>
#include <cmath>

#include "ui/board_painter.h"
#include "ui/camera_overlay.h"
#include "ui/theme.h"

namespace helical {
namespace {

constexpr double kZoomPerStep = 1.25;

}  // namespace

CameraView::CameraView(const QColor& identity, QSize sensor, int marker_count, QWidget* parent)
    : QWidget(parent), identity_(identity), marker_count_(marker_count) {
  viewport_.setSensor(sensor);
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
  if (!picture.bgr.empty()) {
    viewport_.setSensor(QSize(picture.width, picture.height));
    scalePicture(picture, viewport_, masks_, devicePixelRatioF(), image_);
  }
  update();
}

void CameraView::setMasks(const PictureMasks& masks) {
  masks_ = masks;
}

void CameraView::setTrailsShown(bool shown) {
  trails_ = shown;
  update();
}

void CameraView::setPickingColour(bool picking) {
  picking_ = picking;
  setCursor(picking ? Qt::PointingHandCursor : Qt::ArrowCursor);
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

double CameraView::handleReach() const {
  return kBoardHandle / viewport_.scale();
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
  const bool left = event->button() == Qt::LeftButton;
  if (left && picking_) {
    Q_EMIT colourPicked(toImage(event->position()));
  } else if (left && boards_.press(toImage(event->position()), handleReach())) {
    tellBoards();
  } else if ((left && viewport_.zoomed()) || event->button() == Qt::MiddleButton) {
    pan_from_ = event->position();
    setCursor(Qt::ClosedHandCursor);
  } else {
    QWidget::mousePressEvent(event);
  }
}

void CameraView::mouseMoveEvent(QMouseEvent* event) {
  if (pan_from_) {
    viewport_.pan(event->position() - *pan_from_);
    pan_from_ = event->position();
    return update();
  }
  if (event->buttons() & Qt::LeftButton) {
    boards_.move(toImage(event->position()));
    return tellBoards();
  }
  updateCursor(event->position());
}

void CameraView::updateCursor(const QPointF& position) {
  if (boards_.tool() != BoardEditor::Tool::kNone || picking_) return;
  const bool grabs = boards_.wouldGrab(toImage(position), handleReach()) || viewport_.zoomed();
  setCursor(grabs ? Qt::OpenHandCursor : Qt::ArrowCursor);
}

void CameraView::mouseReleaseEvent(QMouseEvent* event) {
  if (pan_from_) {
    pan_from_.reset();
    return updateCursor(event->position());
  }
  if (event->button() != Qt::LeftButton) return;
  const BoardEditor::Tool before = boards_.tool();
  boards_.release();
  tellBoards();
  if (boards_.tool() != before) setBoardTool(boards_.tool());
}

void CameraView::mouseDoubleClickEvent(QMouseEvent* event) {
  if (boards_.wouldGrab(toImage(event->position()), handleReach())) return;
  viewport_.reset();
  updateCursor(event->position());
  update();
}

void CameraView::wheelEvent(QWheelEvent* event) {
  viewport_.zoomAt(event->position(), std::pow(kZoomPerStep, event->angleDelta().y() / 120.0));
  updateCursor(event->position());
  update();
  event->accept();
}

void CameraView::resizeEvent(QResizeEvent*) {
  viewport_.setRoom(size());
}

void CameraView::setExposure(const QString& text) {
  if (text == exposure_) return;
  exposure_ = text;
  update();
}

void CameraView::setCaptions(const QString& left, const QString& right) {
  if (left == left_caption_ && right == right_caption_) return;
  left_caption_ = left;
  right_caption_ = right;
  update();
}

void CameraView::paintMarks(QPainter& painter, const QRect& area) const {
  painter.save();
  painter.setClipRect(area);
  painter.translate(toWidget({-0.5, -0.5}));
  CameraOverlay overlay;
  overlay.track = observed_ ? history_.at(observation_.exposure) : history_.newest();
  overlay.observation = observed_ ? &observation_ : nullptr;
  overlay.marker_count = marker_count_;
  overlay.magnification = magnification_;
  overlay.history = trails_ ? &history_ : nullptr;
  paintOverlay(painter, overlay, viewport_.scale());
  painter.restore();
}

void CameraView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), QColor(7, 9, 12));
  const QRect area = viewport_.area();
  if (image_.isNull())
    painter.fillRect(area, QColor(13, 17, 22));
  else
    painter.drawImage(area, image_);
  paintMarks(painter, area);
  painter.save();
  painter.setClipRect(area);
  paintBoards(painter);
  painter.restore();
  if (hidden_) paintHidden(painter, area);
  paintFrame(painter, area);
  paintCaptions(painter, area);
  ++paints_;
  if (!had_image_ && !image_.isNull()) {
    had_image_ = true;
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
  const double left = area.left() + 14, right = area.right() - 14;
  const double top = area.top() + 12, bottom = area.bottom() - 27;
  const auto paint = [&](const QString& text, double from, double line) {
    if (text.isEmpty()) return;
    const QRectF box(from, line, metrics.horizontalAdvance(text), 15.0);
    painter.fillRect(box.adjusted(-4, 0, 4, 0), QColor(8, 12, 16, 150));
    painter.setPen(QColor(205, 215, 226));
    painter.drawText(box, Qt::AlignVCenter, text);
  };
  paint(left_caption_, left, bottom);
  const int right_width = metrics.horizontalAdvance(right_caption_);
  if (metrics.horizontalAdvance(left_caption_) + 12 + right_width <= right - left)
    paint(right_caption_, right - right_width, bottom);
  const QString zoom = viewport_.zoomed() ? tr("%1 x").arg(viewport_.zoom(), 0, 'f', 1) : QString();
  paint(zoom, right - metrics.horizontalAdvance(zoom), top);
  if (metrics.horizontalAdvance(exposure_) + 60 <= right - left) paint(exposure_, left, top);
}

void CameraView::paintBoards(QPainter& painter) const {
  const WhiteBoards& boards = boards_.boards();
  const auto to_screen = [this](const Eigen::Vector2d& pixel) { return toWidget(pixel); };
  painter.setRenderHint(QPainter::Antialiasing);
  // The frames show the boards themselves; without images nothing else would.
  for (int i = 0; i < boards.count; ++i)
    paintBoard(painter, boards.boards[static_cast<std::size_t>(i)], false, image_.isNull(), to_screen);
  if (boards_.draft().count >= 2) paintBoard(painter, boards_.draft(), true, true, to_screen);
}

void CameraView::paintHidden(QPainter& painter, const QRectF& area) const {
  painter.fillRect(area, QColor(7, 9, 12, 165));
  painter.setFont(theme::capsFont(9));
  painter.setPen(theme::on_dark::kCaution);
  painter.drawText(area, Qt::AlignCenter, tr("Hidden from the tracker"));
}

}  // namespace helical
