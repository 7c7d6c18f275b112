#pragma once

#include <QObject>
#include <QSizeF>
#include <filesystem>
#include <memory>

#include "engine/session/export_selection.h"
#include "ui/scene_frame.h"

namespace helical {

class FilmWriter;
class FlightPlayback;
class OrbitView;
class SceneFrameBuilder;
class SceneThread;

/// A film of the 3D view of a recorded flight: scene.mp4 in the order's folder, 30 pictures a second of the
/// flight's time, the whole field from the side with the cameras' names, time and phase. Each picture is drawn
/// by the render thread while the window goes on; needs the X display. The window's thread.
class SceneFilm : public QObject {
  Q_OBJECT

 public:
  /// Throws Error for what is no session and a folder that cannot be made.
  explicit SceneFilm(const ExportOrder& order);
  ~SceneFilm() override;  ///< a film that is not finished is gone

  void start();
  const std::filesystem::path& file() const { return file_; }

 Q_SIGNALS:
  void progressed(double done);
  /// Once; why it could not be made, empty when it was.
  void finished(const QString& failure);

 private:
  void step();
  void add(const RenderedScene& scene);
  void paintWords(QImage& picture, const RenderedScene& scene) const;
  void end(const QString& failure);

  std::filesystem::path file_;
  std::unique_ptr<FlightPlayback> playback_;
  const SceneSetup setup_;
  std::unique_ptr<SceneFrameBuilder> builder_;
  std::unique_ptr<OrbitView> orbit_;
  std::uint32_t seen_cameras_ = 0;  ///< that the eye makes room for, one bit each
  std::unique_ptr<SceneThread> renderer_;
  std::unique_ptr<FilmWriter> writer_;
  TimeNs begin_ = 0, end_ = 0, now_ = 0;
  bool ended_ = false;
};

}  // namespace helical
