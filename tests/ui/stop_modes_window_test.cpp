// STOP in every mode of a flight, and nothing turns the rotors on again.

#include <QPushButton>

#include "tests/ui/window_fixture.h"
#include "ui/hold_button.h"
#include "ui/top_bar.h"

namespace helical {
namespace {

class StopInMode : public WindowTest {
 protected:
  bool cut() const { return snapshot().safety == SafetyState::kCut; }
  TopBar& bar() { return window_->topBar(); }
  void armByMouse() {
    ASSERT_TRUE(eventually([this] { return snapshot().tick > 0 && snapshot().failing_checks == 0; }));
    ASSERT_TRUE(eventually([this] { return bar().armButton()->isEnabled(); }));
    // A busy machine may fail a check for a moment: then somebody holds it down again.
    for (int tries = 0; tries < 20 && !snapshot().armed; ++tries) {
      QTest::mousePress(bar().armButton(), Qt::LeftButton);
      ASSERT_TRUE(eventually([this] { return bar().armButton()->progress() == 0.0; }));
      const std::uint64_t tick = snapshot().tick;
      ASSERT_TRUE(eventually([&] { return snapshot().armed || snapshot().tick > tick + 60; }));
      QTest::mouseRelease(bar().armButton(), Qt::LeftButton);
    }
    ASSERT_TRUE(eventually([this] { return bar().takeOffButton()->isEnabled(); }));
  }
  void byEsc() {
    press(Qt::Key_Escape);
    expectTheEnd();
  }
  void byTheButton() {
    QTest::mousePress(bar().stopButton(), Qt::LeftButton);
    expectTheEnd();
    QTest::mouseRelease(bar().stopButton(), Qt::LeftButton);
  }
  /// Cut, and whatever is tried: it stays cut.
  void expectTheEnd() {
    ASSERT_TRUE(eventually([this] { return cut() && bar().readiness() == "Cut"; }));
    for (QPushButton* button : {static_cast<QPushButton*>(bar().armButton()), bar().takeOffButton(),
                                bar().holdButton(), bar().landButton()}) {
      EXPECT_FALSE(button->isEnabled()) << button->text().toStdString();
      click(button);
    }
    engine_->arm();
    engine_->takeOff();
    const std::uint64_t tick = snapshot().tick;
    ASSERT_TRUE(eventually([&] { return snapshot().tick > tick + 30; }));
    EXPECT_TRUE(cut());
    EXPECT_EQ(snapshot().sticks.upper_rotor, 0.0);
    EXPECT_EQ(snapshot().sticks.lower_rotor, 0.0);
  }
};

TEST_F(StopInMode, OnThePad) {
  open(false);
  ASSERT_TRUE(eventually([this] { return snapshot().pose_known; }));
  byEsc();
}

TEST_F(StopInMode, Armed) {
  open(false);
  ASSERT_NO_FATAL_FAILURE(armByMouse());
  byTheButton();
}

TEST_F(StopInMode, WhileArmIsHeldDown) {
  open(false);
  ASSERT_TRUE(eventually([this] { return bar().armButton()->isEnabled(); }));
  QTest::mousePress(bar().armButton(), Qt::LeftButton);
  ASSERT_TRUE(eventually([this] { return bar().armButton()->progress() > 0.1; }));
  byEsc();
  EXPECT_FALSE(snapshot().armed);
}

TEST_F(StopInMode, TakingOff) {
  open(false);
  ASSERT_NO_FATAL_FAILURE(armByMouse());
  click(bar().takeOffButton());
  ASSERT_TRUE(reaches(FlightPhase::kLiftOff));
  byTheButton();
}

TEST_F(StopInMode, HoldingAndThenOnlyFalling) {
  open(false);
  ASSERT_NO_FATAL_FAILURE(takeOffByMouse());
  ASSERT_TRUE(eventually([this] { return bar().holdButton()->isEnabled(); }));
  click(bar().holdButton());
  ASSERT_TRUE(eventually([this] { return snapshot().holding; }));
  byEsc();
}

TEST_F(StopInMode, Landing) {
  open(false);
  ASSERT_NO_FATAL_FAILURE(takeOffByMouse());
  ASSERT_TRUE(eventually([this] { return bar().landButton()->isEnabled(); }));
  click(bar().landButton());
  ASSERT_TRUE(reaches(FlightPhase::kLanding));
  byTheButton();
}

TEST_F(StopInMode, AFlightThatStartedByItselfDoesNotStartAgain) {
  open(false, true);
  ASSERT_TRUE(reaches(FlightPhase::kFlying));
  byEsc();
}

}  // namespace
}  // namespace helical
