#pragma once

#include <vtkSmartPointer.h>

#include <array>
#include <vector>

#include "ui/scene_frame.h"

class vtkActor;
class vtkRenderer;
class vtkTransform;

namespace helical {

/// The helicopter of the 3D scene with its marker balls and turning rotors; faint where it was last seen.
/// Render thread.
class SceneHelicopter {
 public:
  SceneHelicopter(const SceneSetup& setup, vtkRenderer& renderer);

  void show(const SceneFrame& frame);

 private:
  void buildBody(const SceneSetup& setup);
  void buildRotors(const SceneSetup& setup);
  void add(const vtkSmartPointer<vtkActor>& actor, vtkTransform* transform);

  vtkRenderer& renderer_;
  vtkSmartPointer<vtkTransform> body_;
  vtkSmartPointer<vtkTransform> upper_rotor_;
  vtkSmartPointer<vtkTransform> lower_rotor_;
  std::vector<vtkSmartPointer<vtkActor>> actors_;
  std::array<vtkSmartPointer<vtkActor>, 2> discs_;
};

}  // namespace helical
