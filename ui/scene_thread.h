#pragma once

#include <QObject>
#include <QOffscreenSurface>
#include <QThread>
#include <memory>

#include "ui/scene_frame.h"

class QOpenGLContext;

namespace helical {

class Scene;
class SceneSurface;

/// Renders scenes on a thread of its own and hands back images, so that the window never waits for OpenGL.
/// Construct, use and destroy on the window's thread.
class SceneThread : public QObject {
  Q_OBJECT

 public:
  explicit SceneThread(const SceneSetup& setup);
  ~SceneThread() override;

  /// False if this machine has no usable OpenGL context.
  bool valid() const { return valid_; }
  /// Starts drawing `frame`; does nothing and returns false while the last one is not done.
  bool request(const SceneFrame& frame, const QSizeF& size, double pixel_ratio);

 Q_SIGNALS:
  void rendered(const helical::RenderedScene& scene);

 private:
  bool prepare();
  RenderedScene render(const SceneFrame& frame, const QSizeF& size, double pixel_ratio);
  void finish();

  SceneSetup setup_;
  QThread thread_;
  QOffscreenSurface offscreen_;
  std::unique_ptr<QOpenGLContext> context_;
  std::unique_ptr<QObject> worker_;  ///< lives on the thread; what it runs touches the three below
  std::unique_ptr<Scene> scene_;
  std::unique_ptr<SceneSurface> surface_;
  bool prepared_ = false;
  bool valid_ = false;
  bool busy_ = false;
};

}  // namespace helical
