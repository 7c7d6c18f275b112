#pragma once

#include <vtkSmartPointer.h>

#include <memory>
#include <vector>

#include "ui/scene_frame.h"

class vtkActor;
class vtkRenderer;

namespace helical {

struct ScenePolyline;

/// The waypoints of the 3D scene, joined in flying order, each on its plumb line. The one that the mouse
/// means is larger; a draft that is not in force yet is drawn in another colour. Render thread.
class ScenePlan {
 public:
  explicit ScenePlan(vtkRenderer& renderer);
  ~ScenePlan();

  void show(const SceneFrame& frame);

 private:
  vtkRenderer& renderer_;
  std::unique_ptr<ScenePolyline> lines_;
  std::vector<vtkSmartPointer<vtkActor>> balls_;
};

}  // namespace helical
