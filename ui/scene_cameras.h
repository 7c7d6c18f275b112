#pragma once

#include <vtkSmartPointer.h>

#include <vector>

#include "ui/scene_frame.h"

class vtkActor;
class vtkRenderer;
class vtkTransform;

namespace helical {

/// The cameras of the 3D scene: body and frustum where one believes to stand, dashed where it truly is, its
/// three standard deviations as an ellipsoid and a cone. Render thread.
class SceneCameras {
 public:
  SceneCameras(const SceneSetup& setup, vtkRenderer& renderer);

  void show(const SceneFrame& frame);

 private:
  struct Actors {
    vtkSmartPointer<vtkTransform> world_from_camera;
    vtkSmartPointer<vtkActor> body;
    vtkSmartPointer<vtkActor> edges;
    vtkSmartPointer<vtkActor> faces;
    vtkSmartPointer<vtkTransform> world_from_true_camera;
    vtkSmartPointer<vtkActor> truth;
    vtkSmartPointer<vtkTransform> spread;
    vtkSmartPointer<vtkActor> ellipsoid;
    vtkSmartPointer<vtkTransform> cone_shape;
    vtkSmartPointer<vtkActor> cone;
  };

  Actors build(const SceneCamera& camera) const;
  void showSpread(const Actors& actors, const SceneCameraPose& pose) const;

  std::vector<Actors> cameras_;
};

}  // namespace helical
