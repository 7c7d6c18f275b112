#pragma once

#include <gtest/gtest.h>

#include <QTest>
#include <functional>
#include <memory>

#include "engine/pipeline/engine.h"
#include "engine/session/recorder.h"
#include "ui/main_window.h"

namespace helical {

/// The real window on the real engine with the shipped rig, in still air.
class WindowTest : public testing::Test {
 protected:
  static constexpr int kPatienceMs = 60'000;  ///< for anything that must happen; no measure of speed

  void open(bool images, bool auto_take_off = false);
  /// `record`: taps the flight, and ends after the window.
  void open(const RigConfig& rig, bool auto_take_off = false, Recorder* record = nullptr);
  void TearDown() override;

  static RigConfig shippedRig(bool images);
  static FlightPlan hoverWithoutEnd();  ///< lands when the test says so
  /// Camera 3 has a first guess and finds its place in flight.
  static RigConfig calibratingRig(bool images);
  static bool eventually(const std::function<bool()>& condition) {
    return QTest::qWaitFor(condition, kPatienceMs);
  }

  const EngineSnapshot& snapshot() const { return engine_->snapshot(); }
  bool usesCamera(int camera) const;
  bool reaches(FlightPhase phase);
  void click(QWidget* button) { QTest::mouseClick(button, Qt::LeftButton); }
  /// As the display server would: the key goes to the window, not to a widget.
  void press(Qt::Key key) { QTest::keyClick(window_->windowHandle(), key); }
  void clickView(const QString& accessible_name);
  void takeOffByMouse();

  std::unique_ptr<Engine> engine_;
  std::unique_ptr<MainWindow> window_;
};

}  // namespace helical
