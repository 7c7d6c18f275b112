#include "app/display.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <QByteArray>
#include <QList>
#include <cstring>

#include "engine/base/error.h"

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

}  // namespace

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

void prepareDisplay() {
  requireDisplay();
  preferGlx();
  keepSoftwareRendererModest();
}

}  // namespace helical
