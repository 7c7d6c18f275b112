// From the window on a flight to the calibration of its transmitter's channels and back, as its user goes it.

// Before Qt, whose word "signals" GLib has as a name.
#include "tests/transmitter/emulated_bus.h"
#include "tests/transmitter/emulated_mcc.h"

#include <gtest/gtest.h>

#include <QAction>
#include <QApplication>
#include <QElapsedTimer>
#include <QMessageBox>
#include <QPushButton>
#include <QTemporaryDir>
#include <QTimer>
#include <string>

#include "app/window.h"
#include "engine/config/plan_file.h"
#include "engine/config/resource_files.h"
#include "engine/config/rig_file.h"
#include "engine/transmitter/output_device.h"
#include "ui/channels_dialog.h"
#include "ui/main_window.h"

namespace helical {
namespace {

constexpr qint64 kWayPatienceMs = 120'000;

template <class Widget>
Widget* shownOf() {
  for (QWidget* widget : QApplication::topLevelWidgets())
    if (auto* found = qobject_cast<Widget*>(widget); found != nullptr && found->isVisible()) return found;
  return nullptr;
}

/// The user's hands: looks every few milliseconds whether the next thing to do can be done.
class Hands : public QObject {
 public:
  Hands() {
    since_.start();
    connect(&timer_, &QTimer::timeout, this, &Hands::look);
    timer_.start(20);
  }
  int steps() const { return steps_; }

 private:
  void look() {
    if (since_.elapsed() > kWayPatienceMs) return QApplication::exit(1);  // the steps tell how far it came
    if (step()) ++steps_;
  }
  bool step() {
    auto* window = shownOf<MainWindow>();
    auto* dialog = shownOf<ChannelsDialog>();
    switch (steps_) {
      case 0:
        return window != nullptr && askForChannels(*window);
      case 1:
        return agree();
      case 2:
        if (window != nullptr || dialog == nullptr) return false;
        dialog->reject();
        return true;
      case 3:
        // The flight that begins anew owns the device again.
        if (window == nullptr || dialog != nullptr || !channelsAction(*window)->isEnabled()) return false;
        window->close();
        return true;
      default:
        return false;
    }
  }
  static QAction* channelsAction(MainWindow& window) {
    for (QAction* action : window.findChildren<QAction*>())
      if (action->text().startsWith("Channels of the transmitter")) return action;
    return nullptr;
  }
  static bool askForChannels(MainWindow& window) {
    QAction* action = channelsAction(window);
    if (action == nullptr || !action->isEnabled()) return false;
    action->trigger();
    return true;
  }
  static bool agree() {
    auto* question = shownOf<QMessageBox>();
    if (question == nullptr) return false;
    question->button(QMessageBox::Yes)->click();
    return true;
  }

  QTimer timer_;
  QElapsedTimer since_;
  int steps_ = 0;
};

Hands* hands = nullptr;
int steps_gone = 0;

void beginToLook() {
  hands = new Hands;
}

void endLooking() {
  steps_gone = hands->steps();
  delete hands;
}

TEST(ChannelsWay, TheWindowClosesForTheDialogAndComesBackWithAFlight) {
  QTemporaryDir home;  // nobody's layout, nor cut off records that are offered to be mended
  for (const char* place : {"XDG_DATA_HOME", "XDG_CONFIG_HOME"}) qputenv(place, home.path().toUtf8());
  EmulatedBus bus;
  const auto port = bus.plug(5, std::make_shared<EmulatedMcc>());
  WindowFlight flight;
  flight.rig = loadRig(resourceFolder() / "rigs" / "paper.toml");
  flight.rig.simulation.images = false;
  flight.rig.transmitter.kind = kMccDevice;
  flight.plan_file = planPath("hover");
  flight.plan = loadPlan(flight.plan_file);
  flight.record = false;
  // runWindow makes the application, and with it the first moment at which there can be a timer.
  qAddPreRoutine(beginToLook);
  qAddPostRoutine(endLooking);
  std::string name = "test_app_windows";
  char* arguments[] = {name.data(), nullptr};
  EXPECT_EQ(runWindow(1, arguments, flight), 0);
  EXPECT_EQ(steps_gone, 4);
}

}  // namespace
}  // namespace helical
