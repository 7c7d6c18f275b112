#include "tests/ui/window_fixture.h"

#include <QPushButton>
#include <QToolButton>

#include "engine/config/plan_file.h"
#include "engine/config/resource_files.h"
#include "engine/config/rig_file.h"
#include "engine/geometry/rotation.h"
#include "engine/pipeline/first_guess.h"
#include "ui/hold_button.h"
#include "ui/top_bar.h"

namespace helical {

RigConfig WindowTest::shippedRig(bool images) {
  RigConfig rig = loadRig(resourceFolder() / "rigs" / "paper.toml");
  rig.simulation.images = images;
  rig.simulation.gust_factor = 0.0;
  rig.safety.arm_rate_share = 0.1;  // a machine that runs other tests, too, loses frames and ticks
  return rig;
}

FlightPlan WindowTest::hoverWithoutEnd() {
  FlightPlan plan = loadPlan(planPath("hover"));
  plan.land_at_s = 1e6;
  return plan;
}

RigConfig WindowTest::calibratingRig(bool images) {
  RigConfig rig = shippedRig(images);
  rig.calibrator = "particle-filter";
  giveFirstGuesses(rig, toRadians(kFirstGuessErrorDeg), kFirstGuessErrorM, 1, false);
  return rig;
}

void WindowTest::open(bool images, bool auto_take_off) {
  open(shippedRig(images), auto_take_off);
}

void WindowTest::open(const RigConfig& rig, bool auto_take_off, Recorder* record) {
  WindowOptions options;
  options.auto_take_off = auto_take_off;
  if (record != nullptr)
    options.pictures = {[record](bool on) { record->recordImages(on); },
                        [record] { return record->recordsImages(); }};
  window_ = std::make_unique<MainWindow>(rig, options);
  window_->fitToScreen();
  window_->show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(window_.get(), kPatienceMs));
  engine_ = std::make_unique<Engine>(rig, hoverWithoutEnd(), record);
  engine_->start();
  window_->attach(*engine_);
}

void WindowTest::TearDown() {
  if (window_) window_->detach();
  window_.reset();
  engine_.reset();
}

bool WindowTest::usesCamera(int camera) const {
  return snapshot().cameras[static_cast<std::size_t>(camera)].track.selected_count > 0;
}

bool WindowTest::reaches(FlightPhase phase) {
  return eventually([this, phase] { return snapshot().phase == phase; });
}

void WindowTest::clickView(const QString& accessible_name) {
  for (QToolButton* button : window_->findChildren<QToolButton*>())
    if (button->accessibleName() == accessible_name) return click(button);
  FAIL() << "no button " << accessible_name.toStdString();
}

void WindowTest::takeOffByMouse() {
  ASSERT_TRUE(eventually([this] { return snapshot().tick > 0 && snapshot().failing_checks == 0; }))
      << "it could not be armed";
  ASSERT_TRUE(eventually([this] { return window_->topBar().armButton()->isEnabled(); }));
  HoldButton* arm = window_->topBar().armButton();
  // A busy machine may fail a check for a moment: then somebody holds it down again.
  for (int tries = 0; tries < 20 && !snapshot().armed; ++tries) {
    QTest::mousePress(arm, Qt::LeftButton);
    ASSERT_TRUE(eventually([arm] { return arm->progress() == 0.0; }));
    const std::uint64_t tick = snapshot().tick;
    ASSERT_TRUE(eventually([&] { return snapshot().armed || snapshot().tick > tick + 60; }));
    QTest::mouseRelease(arm, Qt::LeftButton);
  }
  ASSERT_TRUE(snapshot().armed) << "held down, and not armed";
  QPushButton* button = window_->topBar().takeOffButton();
  ASSERT_TRUE(eventually([button] { return button->isEnabled(); })) << "not armed";
  click(button);
  ASSERT_TRUE(reaches(FlightPhase::kFlying));
}

}  // namespace helical
