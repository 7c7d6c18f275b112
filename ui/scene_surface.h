#pragma once

#include <vtkSmartPointer.h>

#include <QImage>
#include <vector>

class QOffscreenSurface;
class QOpenGLContext;
class vtkGenericOpenGLRenderWindow;
class vtkObject;
class vtkRenderer;

namespace helical {

/// A VTK render window that draws through a context of ours into an image. All of it on the render thread,
/// with the context current.
class SceneSurface {
 public:
  SceneSurface(QOpenGLContext& context, QOffscreenSurface& surface, vtkRenderer* renderer);
  ~SceneSurface();
  SceneSurface(const SceneSurface&) = delete;
  SceneSurface& operator=(const SceneSurface&) = delete;

  QImage render(const QSize& pixels);

 private:
  void answer(vtkObject* caller, unsigned long event, void* data);

  QOpenGLContext& context_;
  QOffscreenSurface& surface_;
  vtkSmartPointer<vtkGenericOpenGLRenderWindow> window_;
  std::vector<unsigned long> observers_;
};

}  // namespace helical
