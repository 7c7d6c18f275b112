#pragma once

#include <QGuiApplication>
#include <memory>

namespace helical::figures {

/// What Qt wants before it can draw words: its application object, on the platform that needs no display,
/// whatever DISPLAY and QT_QPA_PLATFORM say. Where the process has one already (the window) that one serves.
/// Leaves the process's locale as it was. The main thread; throws `Error` if there is no font to draw with.
class OffscreenApplication {
 public:
  OffscreenApplication();

 private:
  std::unique_ptr<QGuiApplication> application_;  ///< null where another serves
};

}  // namespace helical::figures
