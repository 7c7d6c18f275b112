#pragma once

#include <QString>
#include <QStringList>
#include <memory>
#include <string>
#include <vector>

class QWidget;

namespace helical {

class Comparison;
class ExportJob;
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
  void exportChosen(const QString& file);
  void compareChosen(const QStringList& files);

 private:
  struct Opened {
    std::unique_ptr<FlightPlayback> playback;
    std::unique_ptr<MainWindow> window;
  };
  void closeHidden();
  void listenTo(MainWindow& window);
  QWidget* anyWindow() const;

  MainWindow* flying_;
  std::vector<Opened> opened_;
  std::vector<std::unique_ptr<ExportJob>> exports_;
  std::vector<std::unique_ptr<Comparison>> comparisons_;
};

}  // namespace helical
