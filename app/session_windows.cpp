#include "app/session_windows.h"

#include "engine/base/error.h"
#include "engine/session/flight_playback.h"
#include "engine/session/session_folder.h"
#include "ui/main_window.h"
#include "ui/open_dialog.h"
#include "ui/top_bar.h"

namespace helical {

SessionWindows::SessionWindows(MainWindow* flying) : flying_(flying) {
  if (flying != nullptr)
    QObject::connect(flying, &MainWindow::sessionChosen, [this](const QString& file) { openChosen(file); });
}

SessionWindows::~SessionWindows() = default;

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
  QObject::connect(&window, &MainWindow::sessionChosen,
                   [this](const QString& chosen) { openChosen(chosen); });
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
    openNotice(flying_, QObject::tr("The session cannot be opened"), QString::fromUtf8(error.what()));
  }
}

}  // namespace helical
