#include "app/session_windows.h"

#include "app/comparison.h"
#include "app/export_job.h"
#include "engine/base/error.h"
#include "engine/session/flight_playback.h"
#include "engine/session/session_folder.h"
#include "ui/main_window.h"
#include "ui/open_dialog.h"
#include "ui/top_bar.h"

namespace helical {

SessionWindows::SessionWindows(MainWindow* flying) : flying_(flying) {
  if (flying != nullptr) listenTo(*flying);
}

SessionWindows::~SessionWindows() = default;

void SessionWindows::listenTo(MainWindow& window) {
  QObject::connect(&window, &MainWindow::sessionChosen, [this](const QString& file) { openChosen(file); });
  QObject::connect(&window, &MainWindow::exportChosen, [this](const QString& file) { exportChosen(file); });
  QObject::connect(&window, &MainWindow::comparisonChosen,
                   [this](const QStringList& files) { compareChosen(files); });
}

QWidget* SessionWindows::anyWindow() const {
  if (flying_ != nullptr) return flying_;
  for (const Opened& one : opened_)
    if (one.window->isVisible()) return one.window.get();
  return nullptr;
}

void SessionWindows::closeHidden() {
  std::erase_if(opened_, [](const Opened& one) { return !one.window->isVisible(); });
}

void SessionWindows::open(const std::string& file) {
  closeHidden();
  Opened opened;
  opened.playback = std::make_unique<FlightPlayback>(file);
  WindowOptions options;
  options.session_folder = QString::fromStdString(sessionFolder().string());
  opened.window = std::make_unique<MainWindow>(opened.playback->rig(), options);
  MainWindow& window = *opened.window;
  listenTo(window);
  if (flying_ != nullptr)
    QObject::connect(&window.topBar(), &TopBar::stopRequested, flying_, &MainWindow::stop);
  // Beside a flight its window alone decides how long there is something to look at.
  window.setAttribute(Qt::WA_QuitOnClose, flying_ == nullptr);
  window.fitToScreen();
  window.show();
  window.attach(*opened.playback);
  opened.playback->play();
  opened_.push_back(std::move(opened));
}

void SessionWindows::openChosen(const QString& file) {
  try {
    open(file.toStdString());
  } catch (const Error& error) {
    openNotice(anyWindow(), QObject::tr("The session cannot be opened"), QString::fromUtf8(error.what()));
  }
}

void SessionWindows::exportChosen(const QString& file) {
  std::erase_if(exports_, [](const auto& job) { return job->over(); });
  try {
    exports_.push_back(std::make_unique<ExportJob>(file.toStdString(), anyWindow()));
  } catch (const Error& error) {
    openNotice(anyWindow(), QObject::tr("The session cannot be exported"), QString::fromUtf8(error.what()));
  }
}

void SessionWindows::compareChosen(const QStringList& files) {
  std::erase_if(comparisons_, [](const auto& one) { return one->over(); });
  if (files.size() < 2) {
    openNotice(anyWindow(), QObject::tr("Compare sessions"), QObject::tr("Choose two sessions or more."));
    return;
  }
  std::vector<std::string> sessions;
  for (const QString& file : files) sessions.push_back(file.toStdString());
  comparisons_.push_back(std::make_unique<Comparison>(std::move(sessions), anyWindow(), flying_ == nullptr));
}

}  // namespace helical
