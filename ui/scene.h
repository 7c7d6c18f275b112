#pragma once

#include <vtkSmartPointer.h>

#include <QSizeF>
#include <array>
#include <memory>
#include <vector>

#include "ui/scene_frame.h"

class vtkActor;
class vtkPoints;
class vtkPolyData;
class vtkRenderer;
class vtkTransform;
class vtkUnsignedCharArray;

namespace helical {

/// Everything the 3D view draws, as VTK actors: floor grid, landing pad, helicopter, markers, trail, cameras,
/// sight rays. Knows nothing of windows or contexts. Built and used on the render thread only.
class Scene {
 public:
  explicit Scene(const SceneSetup& setup);
  ~Scene();

  vtkRenderer* renderer() const;
  void show(const SceneFrame& frame);
  /// Where the cameras' names belong in a picture of `size`, top left origin.
  std::vector<SceneLabel> labels(const SceneFrame& frame, const QSizeF& size) const;

 private:
  struct CameraActors;
  struct Polyline;

  void buildPasses();
  void buildFloor(const SceneSetup& setup);
  void buildHelicopter(const SceneSetup& setup);
  void buildRotors(const SceneSetup& setup);
  void buildCameras(const SceneSetup& setup);
  void buildLines();
  void buildFence(const SceneSetup& setup);
  void buildPlan(const SceneSetup& setup);
  void add(const vtkSmartPointer<vtkActor>& actor);
  void addToHelicopter(const vtkSmartPointer<vtkActor>& actor, vtkTransform* transform);

  void showHelicopter(const SceneFrame& frame);
  void showCameras(const SceneFrame& frame);
  void showSpread(const CameraActors& actors, const SceneCameraPose& pose);
  void showCoverage(const SceneFrame& frame);
  void showParticles(const SceneFrame& frame);
  void showTrail(const SceneFrame& frame);
  void showRays(const SceneFrame& frame);
  void showReference(const SceneFrame& frame);

  std::vector<QColor> camera_colors_;
  vtkSmartPointer<vtkRenderer> renderer_;
  vtkSmartPointer<vtkTransform> floor_;
  vtkSmartPointer<vtkTransform> body_;
  vtkSmartPointer<vtkTransform> upper_rotor_;
  vtkSmartPointer<vtkTransform> lower_rotor_;
  vtkSmartPointer<vtkTransform> set_point_;
  std::vector<vtkSmartPointer<vtkActor>> helicopter_;
  std::array<vtkSmartPointer<vtkActor>, 2> discs_;
  vtkSmartPointer<vtkActor> set_point_actor_;
  std::vector<CameraActors> cameras_;
  std::unique_ptr<Polyline> trail_;
  std::unique_ptr<Polyline> rays_;
  std::unique_ptr<Polyline> drop_line_;
  std::unique_ptr<Polyline> particles_;
  std::unique_ptr<Polyline> coverage_;
  std::shared_ptr<const std::vector<Eigen::Vector3d>> shown_coverage_;
  vtkSmartPointer<vtkActor> fence_;
};

}  // namespace helical
