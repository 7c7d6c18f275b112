#include "app/window.h"

#include <QApplication>
#include <QStandardPaths>
#include <chrono>
#include <cstdio>
#include <future>
#include <memory>

#include "app/display.h"
#include "app/mending_offer.h"
#include "app/session_windows.h"
#include "engine/base/error.h"
#include "engine/config/resource_files.h"
#include "engine/config/text_file.h"
#include "engine/geometry/rotation.h"
#include "engine/pipeline/engine.h"
#include "engine/pipeline/first_guess.h"
#include "engine/session/flight_playback.h"
#include "engine/session/recorder.h"
#include "engine/session/session_folder.h"
#include "ui/catalogue.h"
#include "ui/main_window.h"
#include "ui/theme.h"

namespace helical {
namespace {

void printFirstImage(qint64 since_process_start) {
  if (qEnvironmentVariableIntValue("HELICAL_PRINT_STARTUP") == 0) return;
  std::fprintf(stderr, "first image after %lld ms\n",
               static_cast<long long>(since_process_start / kNanosecondsPerMillisecond));
}

/// `catalogue` must live as long as the window.
void dress(QApplication& application, Catalogue& catalogue) {
  QApplication::setApplicationName(QStringLiteral("helical"));
  QApplication::setApplicationDisplayName(QStringLiteral("Helical Ground Control"));
  const QString folder = QString::fromStdString((resourceFolder() / "translations").string());
  if (catalogue.loadFor(QLocale::system().uiLanguages(), folder)) QApplication::installTranslator(&catalogue);
  theme::apply(application);
}

/// The flight goes on, whatever the disk says: the window tells.
std::unique_ptr<Recorder> startRecorder(const WindowFlight& flight) {
  if (!flight.record) return nullptr;
  SessionSettings settings;
  settings.rig_text = readTextFile(flight.rig.path, "rig file");
  settings.plan_text = readTextFile(flight.plan_file, "flight plan");
  settings.rig = flight.rig;
  settings.plan = flight.plan;
  settings.realtime = true;
  settings.images = flight.images;
  std::filesystem::path file = sessionFolder();
  try {
    file = newSessionFile(file, flight.rig.path, std::chrono::system_clock::now());
  } catch (const Error&) {
    // Opening the folder itself fails, too, with the reason.
  }
  return std::make_unique<Recorder>(file, settings, Recorder::WhenFull::kDrop, Recorder::WhenRefused::kFlyOn);
}

}  // namespace

int runWindow(int argc, char** argv, WindowFlight flight) {
  RigConfig& rig = flight.rig;
  if (flight.demonstration) {
    // What there is to see of it are particles that gather where the camera is.
    rig.calibrator = "particle-filter";
    giveFirstGuesses(rig, toRadians(kFirstGuessErrorDeg), kFirstGuessErrorM, rig.simulation.seed, false);
  }
  prepareDisplay();
  const std::vector<std::filesystem::path> cut_off = cutOffSessions(sessionFolder());
  const std::unique_ptr<Recorder> recorder = startRecorder(flight);
  // The engine prepares its sources while Qt opens the display.
  auto starting = std::async(std::launch::async, [&flight, &recorder] {
    auto engine = std::make_unique<Engine>(flight.rig, flight.plan, recorder.get());
    engine->start();
    return engine;
  });
  QApplication application(argc, argv);
  Catalogue catalogue;
  dress(application, catalogue);
  WindowOptions options;
  options.auto_take_off = flight.demonstration;
  options.session_folder = QString::fromStdString(sessionFolder().string());
  options.layout_file = QStandardPaths::writableLocation(QStandardPaths::AppConfigLocation) + "/layout.ini";
  MainWindow window(rig, options);
  QObject::connect(&window, &MainWindow::firstImage, &printFirstImage);
  if (!window.restoreLayout()) window.fitToScreen();
  window.show();
  const std::unique_ptr<Engine> engine = starting.get();
  window.attach(*engine);
  MendingOffer offer(window, cut_off);
  SessionWindows sessions(&window);
  const int exit_code = QApplication::exec();
  window.detach();
  engine->stop();
  if (recorder) recorder->finish();
  return exit_code;
}

int runSessionWindow(int argc, char** argv, const std::string& session) {
  FlightPlayback{session};  // says what is wrong with it before a display is asked for
  prepareDisplay();
  QApplication application(argc, argv);
  Catalogue catalogue;
  dress(application, catalogue);
  SessionWindows sessions;
  sessions.open(session);
  return QApplication::exec();
}

}  // namespace helical
