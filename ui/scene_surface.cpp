#include "ui/scene_surface.h"

#include <vtkCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLState.h>
#include <vtkRenderer.h>

#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLExtraFunctions>

namespace helical {

SceneSurface::SceneSurface(QOpenGLContext& context, QOffscreenSurface& surface, vtkRenderer* renderer)
    : context_(context), surface_(surface), window_(vtkSmartPointer<vtkGenericOpenGLRenderWindow>::New()) {
  window_->SetReadyForRendering(false);
  window_->SetFrameBlitModeToNoBlit();
  window_->SetMultiSamples(0);
  window_->AddRenderer(renderer);
  for (const auto event : {vtkCommand::WindowMakeCurrentEvent, vtkCommand::WindowIsCurrentEvent})
    observers_.push_back(window_->AddObserver(event, this, &SceneSurface::answer));
  window_->SetForceMaximumHardwareLineWidth(1);
  window_->SetOwnContext(0);
  window_->SetReadyForRendering(true);
  window_->GetState()->Reset();
  window_->GetState()->vtkglDepthFunc(GL_LEQUAL);
  window_->OpenGLInitContext();
}

SceneSurface::~SceneSurface() {
  window_->Finalize();
  window_->SetReadyForRendering(false);
  for (const unsigned long observer : observers_) window_->RemoveObserver(observer);
}

void SceneSurface::answer(vtkObject*, unsigned long event, void* data) {
  if (event == vtkCommand::WindowMakeCurrentEvent)
    context_.makeCurrent(&surface_);
  else
    *static_cast<bool*>(data) =
        QOpenGLContext::currentContext() == &context_ && context_.surface() == &surface_;
}

QImage SceneSurface::render(const QSize& pixels) {
  window_->SetSize(pixels.width(), pixels.height());
  window_->SetScreenSize(pixels.width(), pixels.height());
  vtkOpenGLState* state = window_->GetState();
  state->Reset();
  state->Push();
  state->vtkglDepthFunc(GL_LEQUAL);
  window_->Render();
  state->Pop();

  QImage image(pixels, QImage::Format_RGB32);
  QOpenGLExtraFunctions* gl = context_.extraFunctions();
  gl->glBindFramebuffer(GL_READ_FRAMEBUFFER, window_->GetDisplayFramebuffer()->GetFBOIndex());
  gl->glReadBuffer(GL_COLOR_ATTACHMENT0);
  gl->glPixelStorei(GL_PACK_ALIGNMENT, 4);
  gl->glReadPixels(0, 0, pixels.width(), pixels.height(), GL_BGRA, GL_UNSIGNED_BYTE, image.bits());
  // OpenGL's first row is the lowest.
  return std::move(image).mirrored();
}

}  // namespace helical
