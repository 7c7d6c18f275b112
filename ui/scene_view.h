#pragma once

#include <QPoint>
#include <QWidget>
#include <memory>

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
  /// What is to be flown; before the first `show`.
  void setPlan(const FlightPlan& plan) { plan_ = plan; }
  /// Asks for a picture of this state; skipped while the last one is being drawn. The first call starts the
  /// render thread.
  void show(const EngineSnapshot& snapshot);
  void look(SceneViewpoint viewpoint);

  double renderMilliseconds() const { return shown_.milliseconds; }
  int renderedFrames() const { return rendered_; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;

 private:
  void paintLabels(QPainter& painter) const;
  void paintUnknownCameras(QPainter& painter) const;

  const RigConfig& rig_;
  FlightPlan plan_;
  SceneFrameBuilder builder_;
  OrbitView orbit_;
  std::unique_ptr<SceneThread> renderer_;
  RenderedScene shown_;
  std::vector<bool> pose_known_;  ///< per camera
  int rendered_ = 0;
  QPoint drag_from_;
};

}  // namespace helical
