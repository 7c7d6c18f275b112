#include "app/scene_export.h"

#include <QEventLoop>
#include <QGuiApplication>
#include <clocale>
#include <exception>
#include <string>

#include "app/display.h"
#include "engine/base/error.h"
#include "ui/scene_film.h"

namespace helical {

bool SceneApplication::possible() {
  try {
    requireDisplay();
  } catch (const Error&) {
    return false;
  }
  // The 3D view draws through GLX.
  return qEnvironmentVariableIsSet("DISPLAY") &&
         (!qEnvironmentVariableIsSet("QT_QPA_PLATFORM") || qgetenv("QT_QPA_PLATFORM") == "xcb");
}

SceneApplication::SceneApplication() {
  static int argc = 1;
  static char name[] = "helical";
  static char* argv[] = {name, nullptr};
  prepareDisplay();
  // Qt turns to the user's locale, in which numbers may have commas: none of ours shall.
  const std::string locale = std::setlocale(LC_ALL, nullptr);
  application_ = std::make_unique<QGuiApplication>(argc, argv);
  std::setlocale(LC_ALL, locale.c_str());
}

SceneApplication::~SceneApplication() = default;

std::filesystem::path exportScene(const ExportOrder& order, const ExportProgress& progress) {
  SceneFilm film(order);
  QEventLoop loop;
  std::exception_ptr ended;
  QString failure;
  QObject::connect(&film, &SceneFilm::progressed, &loop, [&](double done) {
    try {
      progress(done);
    } catch (...) {
      ended = std::current_exception();
      loop.quit();
    }
  });
  QObject::connect(&film, &SceneFilm::finished, &loop, [&](const QString& why) {
    failure = why;
    loop.quit();
  });
  film.start();
  loop.exec();
  if (ended) std::rethrow_exception(ended);
  if (!failure.isEmpty())
    throw Error(ErrorKind::kSystem, failure.toStdString(), film.file().string(),
                "choose a folder that can be written to, on a machine with OpenGL 3.2");
  return film.file();
}

}  // namespace helical
