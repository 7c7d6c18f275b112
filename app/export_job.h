#pragma once

#include <QObject>
#include <QPointer>
#include <atomic>
#include <memory>
#include <thread>

#include "app/session_export.h"
#include "ui/export_dialog.h"

namespace helical {

class SceneFilm;

/// Asks what to export of a session and does it, on a thread of its own; the film of the 3D view beside the
/// window. The window's thread.
class ExportJob {
 public:
  /// Opens the dialog. Throws Error for what is no session.
  ExportJob(const std::filesystem::path& session, QWidget* parent);
  ~ExportJob();  ///< cancels, and waits for that
  ExportJob(const ExportJob&) = delete;
  ExportJob& operator=(const ExportJob&) = delete;

  /// Nothing more comes of it.
  bool over() const { return dialog_.isNull() && !running_; }
  ExportDialog* dialog() const { return dialog_; }

 private:
  void start(const ExportOrder& order);
  void run(const ExportOrder& order);
  void report(double done, const QString& step);
  void filmScene(const ExportOrder& order);
  void end(const QString& text);

  QPointer<ExportDialog> dialog_;
  QObject here_;  ///< what happens on the window's thread; with it ends what still waits
  std::unique_ptr<SceneFilm> film_;
  SessionExport done_;
  bool running_ = false;  ///< window's thread
  std::atomic<bool> cancelled_{false};
  std::thread thread_;
};

}  // namespace helical
