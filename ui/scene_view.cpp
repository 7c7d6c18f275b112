#include "ui/scene_view.h"

#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "ui/scene_thread.h"
#include "ui/theme.h"

namespace helical {
namespace {

constexpr double kTurnPerPixel = 0.008;  // rad
constexpr double kZoomPerStep = 0.88;

/// How far from the pad the farthest camera of known pose stands.
double reachOf(const RigConfig& rig) {
  double reach = 0.0;
  for (const CameraConfig& camera : rig.cameras)
    if (camera.camera_from_world)
      reach = std::max(reach, camera.camera_from_world->inverseTranslation().head<2>().norm());
  return reach;
}

}  // namespace

SceneView::SceneView(const RigConfig& rig, QWidget* parent)
    : QWidget(parent), rig_(rig), builder_(rig), orbit_(reachOf(rig)) {
  setAttribute(Qt::WA_OpaquePaintEvent);
  setMinimumSize(320, 200);
  setFocusPolicy(Qt::StrongFocus);
  setAccessibleName(tr("3D scene"));
  setToolTip(tr("Drag: turn.  Right drag or Shift and drag: move.  Wheel: zoom."));
}

SceneView::~SceneView() = default;

void SceneView::addTick(const EngineSnapshot& tick) {
  builder_.addTick(tick);
}

void SceneView::look(SceneViewpoint viewpoint) {
  orbit_.look(viewpoint);
}

void SceneView::show(const EngineSnapshot& snapshot) {
  if (!isVisible()) return;
  if (!renderer_) {
    renderer_ = std::make_unique<SceneThread>(sceneSetup(rig_, plan_));
    connect(renderer_.get(), &SceneThread::rendered, this, [this](const RenderedScene& scene) {
      shown_ = scene;
      ++rendered_;
      update();
    });
  }
  SceneFrame frame = builder_.build(snapshot);
  pose_known_.clear();
  for (const SceneCameraPose& camera : frame.cameras) pose_known_.push_back(camera.known);
  orbit_.track(frame.world_from_body.translation);
  frame.eye = orbit_.eye();
  frame.focus = orbit_.focus();
  frame.up = orbit_.up();
  renderer_->request(frame, size(), devicePixelRatioF());
}

void SceneView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  if (shown_.image.isNull()) {
    painter.fillRect(rect(), QColor(12, 16, 21));
    painter.setPen(theme::kMuted);
    painter.drawText(
        rect(), Qt::AlignCenter,
        renderer_ && !renderer_->valid() ? tr("The 3D view needs OpenGL 3.2") : tr("Starting the 3D view"));
    return;
  }
  painter.drawImage(rect(), shown_.image);
  painter.setRenderHint(QPainter::Antialiasing);
  paintLabels(painter);
  paintUnknownCameras(painter);
}

void SceneView::paintLabels(QPainter& painter) const {
  painter.setFont(theme::capsFont(7.6));
  for (const SceneLabel& label : shown_.labels) {
    const auto camera = static_cast<std::size_t>(label.camera);
    QColor color = theme::cameraColor(label.camera);
    if (!label.in_use) color.setAlpha(110);
    painter.setPen(color);
    const QRectF box(label.position - QPointF(90, 9), QSizeF(180, 18));
    painter.drawText(box, Qt::AlignCenter, QString::fromStdString(rig_.cameras[camera].name));
  }
}

void SceneView::paintUnknownCameras(QPainter& painter) const {
  int line = 0;
  for (std::size_t i = 0; i < pose_known_.size(); ++i) {
    if (pose_known_[i]) continue;
    painter.setFont(theme::uiFont(8.4));
    painter.setPen(theme::cameraColor(static_cast<int>(i)));
    painter.drawText(QPointF(12, 20 + 17 * line++),
                     tr("%1: place not known yet").arg(QString::fromStdString(rig_.cameras[i].name)));
  }
}

void SceneView::mousePressEvent(QMouseEvent* event) {
  drag_from_ = event->pos();
}

void SceneView::mouseMoveEvent(QMouseEvent* event) {
  const QPoint moved = event->pos() - drag_from_;
  drag_from_ = event->pos();
  const bool shift = event->modifiers().testFlag(Qt::ShiftModifier);
  if (event->buttons() & (Qt::RightButton | Qt::MiddleButton) || (event->buttons() & Qt::LeftButton && shift))
    orbit_.pan(-static_cast<double>(moved.x()) / height(), static_cast<double>(moved.y()) / height());
  else if (event->buttons() & Qt::LeftButton)
    orbit_.turn(-kTurnPerPixel * moved.x(), kTurnPerPixel * moved.y());
}

void SceneView::wheelEvent(QWheelEvent* event) {
  orbit_.zoom(std::pow(kZoomPerStep, event->angleDelta().y() / 120.0));
  event->accept();
}

}  // namespace helical
