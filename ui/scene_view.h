#pragma once

#include <QPoint>
#include <QWidget>
#include <memory>
#include <optional>

#include "engine/config/rig_config.h"
#include "engine/pipeline/snapshot.h"
#include "ui/orbit_view.h"
#include "ui/scene_frame_builder.h"

namespace helical {

class SceneThread;

/// The 3D view. Drag turns, right drag or Shift-drag pans, the wheel zooms. Pictures come from the render
/// thread; painting only copies the newest and writes the cameras' names over it.
class SceneView : public QWidget {
  Q_OBJECT

 public:
  explicit SceneView(const RigConfig& rig, QWidget* parent = nullptr);
  ~SceneView() override;

  void addTick(const EngineSnapshot& tick);
  void setCalibration(int camera, const CalibrationView& view) { builder_.setCalibration(camera, view); }
  void setCoverageShown(bool shown) { builder_.setCoverageShown(shown); }
  /// The waypoints to be shown; a `draft` is not in force yet.
  void setPlan(const FlightPlan& plan, bool draft) { builder_.setPlan(plan, draft); }
  /// Asks for a picture of this state; skipped while the last one is being drawn. The first call starts the
  /// render thread.
  void show(const EngineSnapshot& snapshot);
  void look(SceneViewpoint viewpoint);
  /// Through a camera, from where it is believed to stand, as it sees.
  void lookThrough(CameraId camera);
  /// Where a waypoint is in the picture that is shown now.
  std::optional<QPointF> waypointPosition(int index) const;

  /// The eye and what it sees, of the last frame asked for.
  const SceneFrame& lastFrame() const { return last_frame_; }
  double renderMilliseconds() const { return shown_.milliseconds; }
  int renderedFrames() const { return rendered_; }

 Q_SIGNALS:
  /// A waypoint was dragged to here, relative to where the helicopter stands on the pad.
  void waypointDragged(int index, const Eigen::Vector3d& position_above_pad);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;

 private:
  void setEye(SceneFrame& frame);
  void fitField(const SceneFrame& frame);
  void dragWaypoint(const QMouseEvent& event);
  void paintUnknownCameras(QPainter& painter) const;

  const RigConfig& rig_;
  const SceneSetup setup_;
  SceneFrameBuilder builder_;
  OrbitView orbit_;
  std::uint32_t fitted_cameras_ = 0;  ///< one bit each: what the field was last made of
  QSize fitted_size_;
  std::unique_ptr<SceneThread> renderer_;
  RenderedScene shown_;
  std::vector<bool> pose_known_;  ///< per camera
  int rendered_ = 0;
  SceneFrame last_frame_;
  int through_ = -1;         ///< the camera that is looked through
  int meant_waypoint_ = -1;  ///< under the mouse
  int dragged_waypoint_ = -1;
  double pad_height_ = 0.0;
  QPoint drag_from_;
};

}  // namespace helical
