#pragma once

#include <vtkSmartPointer.h>

#include <QSizeF>
#include <memory>
#include <vector>

#include "ui/scene_frame.h"

class vtkActor;
class vtkRenderer;
class vtkTransform;

namespace helical {

class SceneCameras;
class SceneHelicopter;
class ScenePlan;
struct ScenePolyline;

/// Everything the 3D view draws, as VTK actors: floor grid, landing pad, helicopter, markers, trail, cameras,
/// sight rays. Knows nothing of windows or contexts. Built and used on the render thread only.
class Scene {
 public:
  explicit Scene(const SceneSetup& setup);
  ~Scene();

  vtkRenderer* renderer() const;
  void show(const SceneFrame& frame);
  /// Of what was shown last, in a picture of `size`.
  SceneProjection projection(const QSizeF& size) const;
  /// Where the cameras' names belong.
  std::vector<SceneLabel> labels(const SceneFrame& frame, const SceneProjection& projection) const;

 private:
  void buildPasses();
  void buildFloor(const SceneSetup& setup);
  void buildLines();
  void buildFence(const SceneSetup& setup);
  void add(const vtkSmartPointer<vtkActor>& actor);

  void showCoverage(const SceneFrame& frame);
  void showParticles(const SceneFrame& frame);
  void showTrail(const SceneFrame& frame);
  void showRays(const SceneFrame& frame);
  void showReference(const SceneFrame& frame);

  std::vector<QColor> camera_colors_;
  vtkSmartPointer<vtkRenderer> renderer_;
  vtkSmartPointer<vtkTransform> floor_;
  vtkSmartPointer<vtkTransform> set_point_;
  vtkSmartPointer<vtkActor> set_point_actor_;
  std::unique_ptr<SceneHelicopter> helicopter_;
  std::unique_ptr<SceneCameras> cameras_;
  std::unique_ptr<ScenePlan> plan_;
  std::unique_ptr<ScenePolyline> trail_;
  std::unique_ptr<ScenePolyline> rays_;
  std::unique_ptr<ScenePolyline> drop_line_;
  std::unique_ptr<ScenePolyline> particles_;
  std::unique_ptr<ScenePolyline> coverage_;
  std::shared_ptr<const std::vector<Eigen::Vector3d>> shown_coverage_;
  vtkSmartPointer<vtkActor> fence_;
};

}  // namespace helical
