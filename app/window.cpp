#include "app/window.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <QApplication>
#include <QStandardPaths>
#include <cstdio>
#include <cstring>
#include <future>
#include <memory>

#include "engine/base/error.h"
#include "engine/geometry/rotation.h"
#include "engine/pipeline/engine.h"
#include "engine/pipeline/first_guess.h"
#include "ui/main_window.h"
#include "ui/theme.h"

namespace helical {
namespace {

/// Whether an X server answers on a local display such as ":0" or ":99.0"; displays elsewhere are left to Qt.
bool localDisplayAnswers(const QByteArray& display) {
  if (!display.startsWith(':')) return true;
  const QByteArray number = display.mid(1).split('.').first();
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const QByteArray path = "/tmp/.X11-unix/X" + number;
  if (path.size() >= static_cast<qsizetype>(sizeof address.sun_path)) return false;
  std::memcpy(address.sun_path, path.constData(), static_cast<std::size_t>(path.size()));
  const int server = socket(AF_UNIX, SOCK_STREAM, 0);
  const bool answers = connect(server, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  close(server);
  return answers;
}

/// Qt would abort the process instead of telling us.
void requireDisplay() {
  const char* const cure =
      "fly without a window: helical fly; or give it a virtual display: xvfb-run -a helical";
  if (qEnvironmentVariableIsSet("QT_QPA_PLATFORM") && qgetenv("QT_QPA_PLATFORM") != "xcb") return;
  const QByteArray display = qgetenv("DISPLAY");
  if (display.isEmpty() && qEnvironmentVariableIsEmpty("WAYLAND_DISPLAY"))
    throw Error(ErrorKind::kSystem, "no display to open the window on", "DISPLAY is not set", cure);
  if (!display.isEmpty() && !localDisplayAnswers(display))
    throw Error(ErrorKind::kSystem, "no X server answers", "DISPLAY=" + display.toStdString(), cure);
}

/// Debian's VTK knows GLX only. What the user has set stays.
void preferGlx() {
  if (!qEnvironmentVariableIsSet("QT_QPA_PLATFORM")) qputenv("QT_QPA_PLATFORM", "xcb");
  if (!qEnvironmentVariableIsSet("QT_XCB_GL_INTEGRATION")) qputenv("QT_XCB_GL_INTEGRATION", "xcb_glx");
}

/// Mesa's software renderer would start a thread per core beside the engine's; without any it draws on our 3D
/// thread, which is nice to the others.
void keepSoftwareRendererModest() {
  if (!qEnvironmentVariableIsSet("LP_NUM_THREADS")) qputenv("LP_NUM_THREADS", "0");
}

void printFirstImage(qint64 since_process_start) {
  if (qEnvironmentVariableIntValue("HELICAL_PRINT_STARTUP") == 0) return;
  std::fprintf(stderr, "first image after %lld ms\n",
               static_cast<long long>(since_process_start / kNanosecondsPerMillisecond));
}

}  // namespace

int runWindow(int argc, char** argv, RigConfig rig, const FlightPlan& plan, bool demonstration) {
  // What there is to see of it are particles that gather where the camera is.
  if (demonstration) rig.calibrator = "particle-filter";
  giveFirstGuesses(rig, toRadians(kFirstGuessErrorDeg), kFirstGuessErrorM, rig.simulation.seed, false);
  requireDisplay();
  preferGlx();
  keepSoftwareRendererModest();
  // The engine prepares its sources while Qt opens the display.
  auto starting = std::async(std::launch::async, [&rig, &plan] {
    auto engine = std::make_unique<Engine>(rig, plan);
    engine->start();
    return engine;
  });
  QApplication application(argc, argv);
  QApplication::setApplicationName(QStringLiteral("helical"));
  QApplication::setApplicationDisplayName(QStringLiteral("Helical Ground Control"));
  theme::apply(application);

  WindowOptions options;
  options.auto_take_off = demonstration;
  options.layout_file = QStandardPaths::writableLocation(QStandardPaths::AppConfigLocation) + "/layout.ini";
  MainWindow window(rig, options);
  QObject::connect(&window, &MainWindow::firstImage, &printFirstImage);
  if (!window.restoreLayout()) window.fitToScreen();
  window.show();
  const std::unique_ptr<Engine> engine = starting.get();
  window.attach(*engine);
  const int exit_code = QApplication::exec();
  window.detach();
  engine->stop();
  return exit_code;
}

}  // namespace helical
