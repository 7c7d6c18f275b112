#pragma once

#include <filesystem>
#include <memory>

#include "engine/session/export_selection.h"

class QGuiApplication;

namespace helical {

/// Qt on the X display that the 3D view draws through, without any window. One a process, before any other
/// application object of Qt; the main thread.
class SceneApplication {
 public:
  /// Whether there is such a display.
  static bool possible();
  SceneApplication();
  ~SceneApplication();
  SceneApplication(const SceneApplication&) = delete;
  SceneApplication& operator=(const SceneApplication&) = delete;

 private:
  std::unique_ptr<QGuiApplication> application_;
};

/// The film of the 3D view, scene.mp4, made at once. Throws Error.
std::filesystem::path exportScene(const ExportOrder& order, const ExportProgress& progress);

}  // namespace helical
