#include "app/export_job.h"

#include <QMetaObject>

#include "engine/base/error.h"
#include "engine/base/log.h"
#include "engine/session/csv_export.h"
#include "engine/session/flight_playback.h"
#include "ui/open_dialog.h"
#include "ui/scene_film.h"

namespace helical {
namespace {

ExportContents contentsOf(const std::filesystem::path& session) {
  const FlightPlayback playback(session);
  ExportContents contents;
  contents.session = session;
  contents.topics = tableTopics(McapReader(session));
  contents.begin_s = toSeconds(playback.begin());
  contents.end_s = toSeconds(playback.end());
  for (std::size_t i = 0; i < playback.rig().cameras.size(); ++i)
    contents.images = contents.images || playback.hasImages(cameraId(static_cast<int>(i)));
  return contents;
}

/// The part of the bar that is for the film of the scene.
constexpr double kSceneShare = 0.5;

}  // namespace

ExportJob::ExportJob(const std::filesystem::path& session, QWidget* parent)
    : dialog_(new ExportDialog(contentsOf(session), parent)) {
  QObject::connect(dialog_, &ExportDialog::startRequested, &here_,
                   [this](const ExportOrder& order) { start(order); });
  QObject::connect(dialog_, &ExportDialog::cancelRequested, &here_, [this] {
    cancelled_ = true;
    if (film_) {
      film_.reset();
      end(QObject::tr("Cancelled"));
    }
  });
  openDialog(dialog_);
}

ExportJob::~ExportJob() {
  cancelled_ = true;
  if (thread_.joinable()) thread_.join();
  delete dialog_;
}

void ExportJob::start(const ExportOrder& order) {
  if (running_) return;
  if (thread_.joinable()) thread_.join();
  running_ = true;
  cancelled_ = false;
  done_ = {};
  thread_ = std::thread([this, order] { run(order); });
}

/// The thread of its own.
void ExportJob::run(const ExportOrder& order) {
  const double share = order.scene ? kSceneShare : 1.0;
  QString failure;
  bool cancelled = false;
  SessionExport done;
  try {
    done = exportSession(order, [&](double part, const std::string& step) {
      if (cancelled_) throw ExportCancelled();
      report(share * part, QString::fromStdString(step));
    });
  } catch (const ExportCancelled&) {
    cancelled = true;
  } catch (const std::exception& error) {
    failure = QString::fromUtf8(error.what());
  }
  QMetaObject::invokeMethod(&here_, [this, order, failure, cancelled, done] {
    done_ = done;
    if (cancelled) return end(QObject::tr("Cancelled"));
    if (!failure.isEmpty()) return end(failure);
    if (order.scene) return filmScene(order);
    end({});
  });
}

void ExportJob::report(double done, const QString& step) {
  QMetaObject::invokeMethod(&here_, [this, done, step] {
    if (dialog_ && running_) dialog_->showProgress(done, step);
  });
}

void ExportJob::filmScene(const ExportOrder& order) {
  if (cancelled_) return end(QObject::tr("Cancelled"));
  try {
    film_ = std::make_unique<SceneFilm>(order);
  } catch (const Error& error) {
    return end(QString::fromUtf8(error.what()));
  }
  QObject::connect(film_.get(), &SceneFilm::progressed, &here_,
                   [this](double done) { report(kSceneShare + (1.0 - kSceneShare) * done, QObject::tr("3D view")); });
  QObject::connect(
      film_.get(), &SceneFilm::finished, &here_,
      [this](const QString& failure) {
        if (!film_) return;  // cancelled while it said so
        if (failure.isEmpty()) done_.files.push_back(film_->file());
        film_.reset();
        end(failure);
      },
      Qt::QueuedConnection);  // it must not be gone while it says so
  film_->start();
}

void ExportJob::end(const QString& text) {
  running_ = false;
  for (const auto& warning : done_.warnings) log(LogLevel::kWarning, warning);
  if (!dialog_) return;
  QString shown = text;
  if (shown.isEmpty() && !done_.files.empty())
    shown = QObject::tr("%n file(s) in %1", "", static_cast<int>(done_.files.size()))
                .arg(QString::fromStdString(done_.files.front().parent_path().string()));
  for (const auto& warning : done_.warnings) shown += QStringLiteral("\n") + QString::fromStdString(warning);
  dialog_->showEnd(shown);
}

}  // namespace helical
