#include "ui/figures/offscreen_application.h"

#include <QFontDatabase>
#include <clocale>
#include <string>

#include "engine/base/check.h"
#include "engine/base/error.h"

namespace helical::figures {
namespace {

/// The option beats the environment, and is not inherited by programs that we may start.
std::unique_ptr<QGuiApplication> createOffscreen() {
  static int argc = 3;
  static char name[] = "helical";
  static char option[] = "-platform";
  static char platform[] = "offscreen";
  static char* argv[] = {name, option, platform, nullptr};
  argc = 3;  // Qt takes out what it understands
  argv[1] = option;
  argv[2] = platform;
  // Qt turns to the user's locale, in which numbers may have commas: none of ours shall.
  const std::string locale = std::setlocale(LC_ALL, nullptr);
  auto application = std::make_unique<QGuiApplication>(argc, argv);
  std::setlocale(LC_ALL, locale.c_str());
  return application;
}

}  // namespace

OffscreenApplication::OffscreenApplication() {
  if (QCoreApplication::instance() == nullptr) application_ = createOffscreen();
  HELICAL_CHECK(qGuiApp != nullptr &&
                qobject_cast<QGuiApplication*>(QCoreApplication::instance()) != nullptr);
  if (QFontDatabase::families().isEmpty())
    throw Error(ErrorKind::kSystem, "there is no font to write the figures with", "fontconfig",
                "install one: apt-get install fonts-inter");
}

}  // namespace helical::figures
