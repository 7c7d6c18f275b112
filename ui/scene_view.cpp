#include "ui/scene_view.h"

#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "ui/scene_extent.h"
#include "ui/scene_labels.h"
#include "ui/scene_thread.h"
#include "ui/theme.h"

namespace helical {
namespace {

constexpr double kTurnPerPixel = 0.008;  // rad
constexpr double kZoomPerStep = 0.88;

}  // namespace

SceneView::SceneView(const RigConfig& rig, QWidget* parent)
    : QWidget(parent), rig_(rig), setup_(sceneSetup(rig)), builder_(rig) {
  setAttribute(Qt::WA_OpaquePaintEvent);
  setMinimumSize(320, 200);
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setAccessibleName(tr("3D scene"));
  setToolTip(
      tr("Drag: turn.  Right drag or Shift and drag: move.  Wheel: zoom.  Drag a waypoint over the "
         "ground, with Ctrl up and down."));
}

SceneView::~SceneView() = default;

void SceneView::addTick(const EngineSnapshot& tick) {
  builder_.addTick(tick);
}

void SceneView::look(SceneViewpoint viewpoint) {
  through_ = -1;
  orbit_.look(viewpoint);
}

void SceneView::lookThrough(CameraId camera) {
  through_ = camera.index();
}

std::optional<QPointF> SceneView::waypointPosition(int index) const {
  if (index < 0 || index >= static_cast<int>(shown_.plan.size())) return std::nullopt;
  return shown_.projection.toWidget(shown_.plan[static_cast<std::size_t>(index)]);
}

void SceneView::show(const EngineSnapshot& snapshot) {
  if (!isVisible()) return;
  if (!renderer_) {
    renderer_ = std::make_unique<SceneThread>(setup_);
    connect(renderer_.get(), &SceneThread::rendered, this, [this](const RenderedScene& scene) {
      shown_ = scene;
      ++rendered_;
      update();
    });
  }
  SceneFrame frame = builder_.build(snapshot);
  pose_known_.clear();
  for (const SceneCameraPose& camera : frame.cameras) pose_known_.push_back(camera.known);
  pad_height_ = snapshot.pad_height;
  frame.meant_waypoint = dragged_waypoint_ >= 0 ? dragged_waypoint_ : meant_waypoint_;
  setEye(frame);
  last_frame_ = frame;
  renderer_->request(frame, size(), devicePixelRatioF());
}

/// A camera that is learning its place moves a little all the time: the view stays where it is.
void SceneView::fitField(const SceneFrame& frame) {
  const std::uint32_t known = knownCameras(frame);
  if (known == fitted_cameras_ && size() == fitted_size_) return;
  fitted_cameras_ = known;
  fitted_size_ = size();
  orbit_.setField(sceneExtent(setup_, frame), static_cast<double>(width()) / std::max(1, height()));
}

void SceneView::setEye(SceneFrame& frame) {
  fitField(frame);
  orbit_.track(frame.world_from_body.translation);
  frame.eye = orbit_.eye();
  frame.focus = orbit_.focus();
  frame.up = orbit_.up();
  const auto through = static_cast<std::size_t>(std::max(0, through_));
  if (through_ < 0 || through >= frame.cameras.size() || !frame.cameras[through].known) return;
  const RigidTransform world_from_camera = frame.cameras[through].camera_from_world.inverse();
  const CameraModel& model = rig_.cameras[through].model;
  frame.eye = world_from_camera.translation;
  frame.focus = world_from_camera * Eigen::Vector3d::UnitZ();
  frame.up = world_from_camera.rotation * -Eigen::Vector3d::UnitY();
  // All of its image, whatever the shape of the window.
  const double vertical = 0.5 * model.height() / model.fy();
  const double horizontal = 0.5 * model.width() / model.fx() * height() / std::max(1, width());
  frame.field_of_view = 2.0 * std::atan(std::max(vertical, horizontal));
  frame.cameras[through].known = false;  // its own frustum would only be in the way
}

void SceneView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  if (shown_.image.isNull()) {
    painter.fillRect(rect(), QColor(12, 16, 21));
    painter.setPen(theme::on_dark::kMuted);
    painter.drawText(
        rect(), Qt::AlignCenter,
        renderer_ && !renderer_->valid() ? tr("The 3D view needs OpenGL 3.2") : tr("Starting the 3D view"));
    return;
  }
  painter.drawImage(rect(), shown_.image);
  painter.setRenderHint(QPainter::Antialiasing);
  paintSceneLabels(painter, shown_.labels, rig_);
  paintUnknownCameras(painter);
}

void SceneView::paintUnknownCameras(QPainter& painter) const {
  int line = 0;
  for (std::size_t i = 0; i < pose_known_.size(); ++i) {
    if (pose_known_[i]) continue;
    painter.setFont(theme::uiFont(8.4));
    painter.setPen(theme::on_dark::cameraColor(static_cast<int>(i)));
    painter.drawText(QPointF(12, 20 + 17 * line++),
                     tr("%1: place not known yet").arg(QString::fromStdString(rig_.cameras[i].name)));
  }
}

void SceneView::mousePressEvent(QMouseEvent* event) {
  drag_from_ = event->pos();
  dragged_waypoint_ = event->button() == Qt::LeftButton && event->modifiers() != Qt::ShiftModifier
                          ? WaypointDrag::at(event->position(), shown_.plan, shown_.projection)
                          : -1;
}

void SceneView::dragWaypoint(const QMouseEvent& event) {
  const auto index = static_cast<std::size_t>(dragged_waypoint_);
  if (index >= shown_.plan.size()) return;
  const auto moved = WaypointDrag::moved(shown_.plan[index], event.position(), shown_.projection,
                                         event.modifiers().testFlag(Qt::ControlModifier));
  if (!moved) return;
  shown_.plan[index] = *moved;
  Q_EMIT waypointDragged(dragged_waypoint_, *moved - Eigen::Vector3d(0.0, 0.0, pad_height_));
}

void SceneView::mouseMoveEvent(QMouseEvent* event) {
  if (dragged_waypoint_ >= 0) return dragWaypoint(*event);
  if (event->buttons() == Qt::NoButton) {
    meant_waypoint_ = WaypointDrag::at(event->position(), shown_.plan, shown_.projection);
    setCursor(meant_waypoint_ >= 0 ? Qt::SizeAllCursor : Qt::ArrowCursor);
    return;
  }
  const QPoint moved = event->pos() - drag_from_;
  drag_from_ = event->pos();
  if (through_ >= 0) return;
  const bool shift = event->modifiers().testFlag(Qt::ShiftModifier);
  if (event->buttons() & (Qt::RightButton | Qt::MiddleButton) || (event->buttons() & Qt::LeftButton && shift))
    orbit_.pan(-static_cast<double>(moved.x()) / height(), static_cast<double>(moved.y()) / height());
  else if (event->buttons() & Qt::LeftButton)
    orbit_.turn(-kTurnPerPixel * moved.x(), kTurnPerPixel * moved.y());
}

void SceneView::mouseReleaseEvent(QMouseEvent*) {
  dragged_waypoint_ = -1;
}

void SceneView::wheelEvent(QWheelEvent* event) {
  orbit_.zoom(std::pow(kZoomPerStep, event->angleDelta().y() / 120.0));
  event->accept();
}

}  // namespace helical
