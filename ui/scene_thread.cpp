#include "ui/scene_thread.h"

#include <sys/resource.h>

#include <QElapsedTimer>
#include <QMetaObject>
#include <QOpenGLContext>
#include <QSurfaceFormat>

#include "ui/scene.h"
#include "ui/scene_surface.h"

namespace helical {
namespace {

constexpr int kNiceness = 10;

QSurfaceFormat sceneFormat() {
  QSurfaceFormat format;
  format.setRenderableType(QSurfaceFormat::OpenGL);
  format.setVersion(3, 2);
  format.setProfile(QSurfaceFormat::CoreProfile);
  format.setDepthBufferSize(24);
  format.setStencilBufferSize(8);
  format.setSwapInterval(0);
  return format;
}

}  // namespace

SceneThread::SceneThread(const SceneSetup& setup)
    : setup_(setup), context_(std::make_unique<QOpenGLContext>()), worker_(std::make_unique<QObject>()) {
  // Qt wants the surface and the context to be made on the window's thread.
  offscreen_.setFormat(sceneFormat());
  offscreen_.create();
  context_->setFormat(sceneFormat());
  valid_ = context_->create() && offscreen_.isValid();
  context_->moveToThread(&thread_);
  worker_->moveToThread(&thread_);
  thread_.setObjectName(QStringLiteral("scene"));
  thread_.start();
  // Pictures must never take the processor from the flight. Qt's thread priorities do nothing here: Linux
  // knows only niceness, and that per thread.
  QMetaObject::invokeMethod(worker_.get(), [] { setpriority(PRIO_PROCESS, 0, kNiceness); });
}

SceneThread::~SceneThread() {
  QMetaObject::invokeMethod(
      worker_.get(), [this] { finish(); }, Qt::BlockingQueuedConnection);
  thread_.quit();
  thread_.wait();
}

bool SceneThread::request(const SceneFrame& frame, const QSizeF& size, double pixel_ratio) {
  if (!valid_ || busy_ || size.isEmpty()) return false;
  busy_ = true;
  QMetaObject::invokeMethod(worker_.get(), [this, frame, size, pixel_ratio] {
    const RenderedScene scene = render(frame, size, pixel_ratio);
    QMetaObject::invokeMethod(this, [this, scene] {
      busy_ = false;
      if (scene.image.isNull()) valid_ = false;
      Q_EMIT rendered(scene);
    });
  });
  return true;
}

bool SceneThread::prepare() {
  if (!context_->makeCurrent(&offscreen_)) return false;
  if (!prepared_) {
    prepared_ = true;
    scene_ = std::make_unique<Scene>(setup_);
    surface_ = std::make_unique<SceneSurface>(*context_, offscreen_, scene_->renderer());
  }
  return true;
}

RenderedScene SceneThread::render(const SceneFrame& frame, const QSizeF& size, double pixel_ratio) {
  QElapsedTimer timer;
  timer.start();
  RenderedScene result;
  if (!prepare()) return result;
  scene_->show(frame);
  result.image = surface_->render((size * pixel_ratio).toSize().expandedTo(QSize(1, 1)));
  result.image.setDevicePixelRatio(pixel_ratio);
  result.projection = scene_->projection(size);
  result.labels = scene_->labels(frame, result.projection);
  result.plan = frame.plan;
  result.milliseconds = static_cast<double>(timer.nsecsElapsed()) * 1e-6;
  return result;
}

void SceneThread::finish() {
  if (surface_) {
    // VTK frees its OpenGL objects here, which needs the context.
    context_->makeCurrent(&offscreen_);
    surface_.reset();
    scene_.reset();
    context_->doneCurrent();
  }
  context_.reset();
}

}  // namespace helical
