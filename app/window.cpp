#include "app/window.h"

#include <QApplication>
#include <QStandardPaths>
#include <algorithm>
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
#include "engine/config/transmitter_writer.h"
#include "engine/geometry/rotation.h"
#include "engine/pipeline/engine.h"
#include "engine/pipeline/first_guess.h"
#include "engine/session/flight_playback.h"
#include "engine/session/recorder.h"
#include "engine/session/session_folder.h"
#include "ui/catalogue.h"
#include "ui/channels_dialog.h"
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
  // What nobody asked for at the start can be asked for in flight.
  const auto off = [](const ImageRecording& images) { return images.quality == ImageQuality::kOff; };
  if (std::all_of(settings.images.begin(), settings.images.end(), off))
    settings.images.assign(flight.rig.cameras.size(), {ImageQuality::kJpeg, 0.0, false});
  std::filesystem::path file = sessionFolder();
  try {
    file = newSessionFile(file, flight.rig.path, std::chrono::system_clock::now());
  } catch (const Error&) {
    // Opening the folder itself fails, too, with the reason.
  }
  return std::make_unique<Recorder>(file, settings, Recorder::WhenFull::kDrop, Recorder::WhenRefused::kFlyOn);
}

/// The engine prepares its sources while Qt opens the display.
struct StartingFlight {
  explicit StartingFlight(const WindowFlight& flight)
      : recorder(startRecorder(flight)), engine(std::async(std::launch::async, [&flight, this] {
          auto started = std::make_unique<Engine>(flight.rig, flight.plan, recorder.get());
          started->start();
          return started;
        })) {}
  std::unique_ptr<Recorder> recorder;
  std::future<std::unique_ptr<Engine>> engine;
};

/// Until the window is closed; true if it is to come back with the transmitter's channels calibrated.
bool runFlight(StartingFlight& starting, const RigConfig& rig, WindowOptions options,
               const std::vector<std::filesystem::path>& cut_off) {
  if (Recorder* record = starting.recorder.get(); record != nullptr)
    options.pictures = {[record](bool on) { record->recordImages(on); },
                        [record] { return record->recordsImages(); }};
  MainWindow window(rig, options);
  bool calibrate = false;
  QObject::connect(&window, &MainWindow::firstImage, &printFirstImage);
  QObject::connect(&window, &MainWindow::channelsRequested, [&] {
    calibrate = true;
    window.close();
    QApplication::quit();
  });
  if (!window.restoreLayout()) window.fitToScreen();
  window.show();
  const std::unique_ptr<Engine> engine = starting.engine.get();
  window.attach(*engine);
  MendingOffer offer(window, cut_off);
  SessionWindows sessions(&window);
  QApplication::exec();
  window.detach();
  engine->stop();
  if (starting.recorder) starting.recorder->finish();
  return calibrate;
}

/// Nobody flies meanwhile: the dialog owns the device.
void calibrateChannels(RigConfig& rig) {
  ChannelsDialog dialog(rig.transmitter, [&rig](const OutputChannels& channels, bool checked) {
    writeChannels(rig.path, rig.path, channels, checked);
    rig.transmitter.channels = channels;
    rig.transmitter.directions_checked = checked ? fingerprintText(channels) : std::string();
  });
  dialog.show();
  QApplication::exec();
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
  std::vector<std::filesystem::path> cut_off = cutOffSessions(sessionFolder());
  auto starting = std::make_unique<StartingFlight>(flight);
  QApplication application(argc, argv);
  Catalogue catalogue;
  dress(application, catalogue);
  WindowOptions options;
  options.auto_take_off = flight.demonstration;
  options.session_folder = QString::fromStdString(sessionFolder().string());
  options.layout_file = QStandardPaths::writableLocation(QStandardPaths::AppConfigLocation) + "/layout.ini";
  while (runFlight(*starting, rig, options, cut_off)) {
    starting.reset();
    calibrateChannels(rig);
    cut_off.clear();
    starting = std::make_unique<StartingFlight>(flight);
  }
  return 0;
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
