#pragma once

#include <QString>
#include <memory>
#include <string>
#include <vector>

namespace helical {

class FlightPlayback;
class MainWindow;

/// Windows on recorded flights, beside the one on the flight or alone. The window's thread.
class SessionWindows {
 public:
  /// STOP in any of them stops the flight of `flying`, if there is one: whoever presses it means that.
  explicit SessionWindows(MainWindow* flying = nullptr);
  ~SessionWindows();

  /// Throws Error for what is no session.
  void open(const std::string& file);
  /// The same for files that the user chose: tells what is wrong with it.
  void openChosen(const QString& file);

 private:
  struct Opened {
    std::unique_ptr<FlightPlayback> playback;
    std::unique_ptr<MainWindow> window;
  };
  void closeHidden();

  MainWindow* flying_;
  std::vector<Opened> opened_;
};

}  // namespace helical
