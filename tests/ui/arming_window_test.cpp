#include <QApplication>

#include "tests/ui/window_fixture.h"
#include "ui/hold_button.h"
#include "ui/preflight_popup.h"
#include "ui/top_bar.h"

namespace helical {
namespace {

class Arming : public WindowTest {
 protected:
  void SetUp() override {
    open(false);
    ASSERT_TRUE(eventually([this] { return snapshot().tick > 0 && snapshot().failing_checks == 0; }));
    ASSERT_TRUE(eventually([this] { return arm()->isEnabled(); }));
  }
  HoldButton* arm() { return window_->topBar().armButton(); }
  void someTicks() {
    const std::uint64_t tick = snapshot().tick;
    ASSERT_TRUE(eventually([&] { return snapshot().tick > tick + 30; }));
  }
};

TEST_F(Arming, AClickDoesNotArm) {
  click(arm());
  QTest::mousePress(arm(), Qt::LeftButton);
  ASSERT_TRUE(eventually([this] { return arm()->progress() > 0.2; })) << "the bar fills";
  QTest::mouseRelease(arm(), Qt::LeftButton);
  EXPECT_EQ(arm()->progress(), 0.0);
  ASSERT_NO_FATAL_FAILURE(someTicks());
  EXPECT_FALSE(snapshot().armed);
}

TEST_F(Arming, HeldDownItArmsAndAClickDisarms) {
  EXPECT_EQ(window_->topBar().pilot(), "Nobody") << "flies it";
  QTest::mousePress(arm(), Qt::LeftButton);
  ASSERT_TRUE(eventually([this] { return snapshot().armed; }));
  EXPECT_TRUE(eventually([this] { return window_->topBar().pilot() == "Helical"; }));
  QTest::mouseRelease(arm(), Qt::LeftButton);
  ASSERT_NO_FATAL_FAILURE(someTicks());
  EXPECT_TRUE(snapshot().armed) << "letting go is no click";
  ASSERT_TRUE(eventually([this] { return arm()->text() == "Disarm"; }));
  click(arm());
  EXPECT_TRUE(eventually([this] { return !snapshot().armed; }));
}

TEST_F(Arming, ThePilotWhoTookOverByTheTrainerSwitchIsNamed) {
  EngineSnapshot taken_over = snapshot();
  taken_over.armed = true;
  taken_over.devices.transmitter.pilot_flies = true;
  window_->topBar().show(taken_over);
  EXPECT_EQ(window_->topBar().pilot(), "Pilot");
}

TEST_F(Arming, SlippingOffIsLettingGo) {
  QTest::mousePress(arm(), Qt::LeftButton);
  QTest::mouseMove(arm(), QPoint(-40, -40));
  EXPECT_EQ(arm()->progress(), 0.0);
  QTest::mouseRelease(arm(), Qt::LeftButton, {}, QPoint(-40, -40));
}

TEST_F(Arming, ByTheKeyboardAloneFromArmToLanding) {
  window_->activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(window_.get(), kPatienceMs));
  arm()->setFocus(Qt::TabFocusReason);
  QTest::keyPress(window_->windowHandle(), Qt::Key_Space);
  ASSERT_TRUE(eventually([this] { return snapshot().armed; }));
  QTest::keyRelease(window_->windowHandle(), Qt::Key_Space);
  ASSERT_TRUE(eventually([this] { return window_->topBar().takeOffButton()->isEnabled(); }));
  press(Qt::Key_Tab);
  EXPECT_EQ(QApplication::focusWidget(), window_->topBar().takeOffButton());
  press(Qt::Key_Space);
  ASSERT_TRUE(reaches(FlightPhase::kFlying));
  EXPECT_EQ(QApplication::focusWidget(), window_->topBar().readinessButton())
      << "not Land or STOP, which come next: another Space must not end the flight";
  ASSERT_TRUE(eventually([this] { return window_->topBar().landButton()->isEnabled(); }));
  for (int i = 0; i < 20 && QApplication::focusWidget() != window_->topBar().landButton(); ++i) press(Qt::Key_Tab);
  press(Qt::Key_Space);
  EXPECT_TRUE(reaches(FlightPhase::kOff));
}

TEST_F(Arming, HoldStaysWhereItIsAndFliesOn) {
  ASSERT_NO_FATAL_FAILURE(takeOffByMouse());
  QPushButton* hold = window_->topBar().holdButton();
  ASSERT_TRUE(eventually([hold] { return hold->isEnabled(); }));
  click(hold);
  ASSERT_TRUE(eventually([this] { return snapshot().holding; }));
  ASSERT_TRUE(eventually([hold] { return hold->text() == "Fly on"; }));
  click(hold);
  EXPECT_TRUE(eventually([this] { return !snapshot().holding; }));
}

}  // namespace
}  // namespace helical
