#include <QApplication>
#include <QPushButton>
#include <QThread>
#include <QToolButton>

#include "tests/ui/window_fixture.h"
#include "ui/camera_pane.h"
#include "ui/camera_wall.h"
#include "ui/event_list.h"
#include "ui/event_panel.h"
#include "ui/panel_title.h"
#include "ui/plot_deck.h"
#include "ui/preflight_popup.h"
#include "ui/scene_view.h"
#include "ui/top_bar.h"

namespace helical {
namespace {

bool isCut(const EngineSnapshot& snapshot) {
  return snapshot.safety == SafetyState::kCut;
}

TEST_F(WindowTest, CameraTwoIsHiddenAndShownInFlightByMouse) {
  open(false);
  ASSERT_NO_FATAL_FAILURE(takeOffByMouse());
  ASSERT_TRUE(eventually([this] { return usesCamera(0) && usesCamera(1); }));

  CameraPane& pane = window_->cameras().pane(1);
  click(pane.hideButton());
  EXPECT_TRUE(eventually([&] { return snapshot().cameras[1].hidden && !usesCamera(1) && usesCamera(0); }));
  EXPECT_TRUE(eventually([&] { return pane.cameraHidden(); })) << "the pane shows what the engine says";
  EXPECT_EQ(pane.title().badge(), "Hidden");
  EXPECT_EQ(pane.hideButton()->text(), "Show");
  EXPECT_FALSE(snapshot().cameras[0].hidden);

  click(pane.hideButton());
  EXPECT_TRUE(eventually([&] { return !snapshot().cameras[1].hidden && usesCamera(1); }));
  EXPECT_TRUE(eventually([&] { return !pane.cameraHidden(); }));
  EXPECT_EQ(pane.title().badge(), "Calibrated");
}

TEST_F(WindowTest, LandsByMouse) {
  open(false);
  ASSERT_NO_FATAL_FAILURE(takeOffByMouse());
  QPushButton* land = window_->topBar().landButton();
  ASSERT_TRUE(eventually([land] { return land->isEnabled(); }));
  click(land);
  ASSERT_TRUE(reaches(FlightPhase::kOff));
  EXPECT_FALSE(isCut(snapshot()));
  EXPECT_TRUE(eventually([this] { return window_->topBar().readiness() == "Landed"; }));
  EXPECT_FALSE(window_->topBar().takeOffButton()->isEnabled());
  EXPECT_FALSE(land->isEnabled());
  EXPECT_GT(window_->events().list().count(), 2);
}

TEST_F(WindowTest, TakesOffByItselfWhenAsked) {
  open(false, true);
  EXPECT_TRUE(reaches(FlightPhase::kFlying));
}

TEST_F(WindowTest, DigitsHideAndShowCameras) {
  open(false);
  ASSERT_TRUE(eventually([this] { return usesCamera(0); }));
  window_->activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(window_.get(), kPatienceMs)) << "shortcuts need an active window";
  press(Qt::Key_1);
  EXPECT_TRUE(eventually([this] { return snapshot().cameras[0].hidden && !usesCamera(0); }));
  // The menu's tick follows the engine; until then the key would ask for the same again.
  ASSERT_TRUE(eventually([this] { return window_->cameras().pane(0).cameraHidden(); }));
  press(Qt::Key_1);
  EXPECT_TRUE(eventually([this] { return !snapshot().cameras[0].hidden && usesCamera(0); }));
}

TEST_F(WindowTest, PlotsMissNoTick) {
  open(false);
  ASSERT_TRUE(eventually([this] { return snapshot().tick > 100; }));
  EXPECT_EQ(engine_->lostTicks(), 0U);
  EXPECT_TRUE(eventually(
      [this] { return window_->plots().history().end() >= static_cast<std::int64_t>(snapshot().tick) - 1; }));
}

TEST_F(WindowTest, AWindowThatStandsStillHoldsNothingUpAndShowsTheNewestStateAfter) {
  open(false);
  ASSERT_NO_FATAL_FAILURE(takeOffByMouse());
  const std::uint64_t before = snapshot().tick;
  QThread::msleep(2000);  // as a dialog of the desktop would
  ASSERT_TRUE(eventually([&] { return snapshot().tick > before; }));
  EXPECT_GT(snapshot().tick, before + 60) << "not the states it missed, one after the other";
  EXPECT_EQ(snapshot().phase, FlightPhase::kFlying);
  EXPECT_EQ(engine_->lostTicks(), 0U) << "and the plots have all of them";
  EXPECT_TRUE(eventually(
      [this] { return window_->plots().history().end() >= static_cast<std::int64_t>(snapshot().tick) - 1; }));
}

TEST_F(WindowTest, TheSceneTurnsWithTheMouse) {
  open(false);
  SceneView& scene = window_->scene();
  ASSERT_TRUE(eventually([&] { return scene.renderedFrames() >= 3; }));
  const QImage before = scene.grab().toImage();
  QTest::mousePress(&scene, Qt::LeftButton, {}, QPoint(200, 200));
  QTest::mouseMove(&scene, QPoint(320, 220));
  QTest::mouseRelease(&scene, Qt::LeftButton, {}, QPoint(320, 220));
  const int frames = scene.renderedFrames();
  ASSERT_TRUE(eventually([&] { return scene.renderedFrames() >= frames + 2; }));
  EXPECT_NE(scene.grab().toImage(), before);
}

TEST_F(WindowTest, TheReadinessWordOpensThePreFlightList) {
  open(false);
  ASSERT_TRUE(eventually([this] { return window_->topBar().readiness() == "Ready"; }));
  click(window_->topBar().readinessButton());
  const PreflightPopup& list = window_->topBar().preflight();
  ASSERT_TRUE(eventually([&] { return list.isVisible(); }));
  EXPECT_GE(list.items().size(), 5U + static_cast<std::size_t>(snapshot().camera_count));
  EXPECT_EQ(worstOf(list.items()), Readiness::kCaution) << "camera 3 has no place, all else is well";
  // An open list does not keep the rotors turning.
  QTest::keyClick(&window_->topBar().preflight(), Qt::Key_Escape);
  EXPECT_TRUE(eventually([this] { return isCut(snapshot()); }));
}

}  // namespace
}  // namespace helical
