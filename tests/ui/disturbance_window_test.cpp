#include <QAction>
#include <QMenu>
#include <QMenuBar>
#include <QToolButton>

#include "engine/geometry/camera_perturbation.h"
#include "tests/ui/window_fixture.h"
#include "ui/camera_pane.h"
#include "ui/camera_tools.h"
#include "ui/camera_view.h"
#include "ui/camera_wall.h"
#include "ui/plot_deck.h"
#include "ui/time_plots.h"
#include "ui/top_bar.h"

namespace helical {
namespace {

class DisturbanceWindow : public WindowTest {
 protected:
  CameraView& view(int camera) { return window_->cameras().pane(camera).view(); }

  void drag(CameraView& on, const QPointF& from, const QPointF& to) {
    QTest::mousePress(&on, Qt::LeftButton, {}, from.toPoint());
    QTest::mouseMove(&on, (0.5 * (from + to)).toPoint());
    QTest::mouseMove(&on, to.toPoint());
    QTest::mouseRelease(&on, Qt::LeftButton, {}, to.toPoint());
  }
  void boardOverAll(int camera) {
    click(window_->cameras().pane(camera).boardButton());
    CameraView& on = view(camera);
    drag(on, on.toWidget({5, 5}), on.toWidget({634, 474}));
  }
  QAction* disturbance(int camera, const QString& part) {
    for (QAction* action : window_->cameras().pane(camera).tools().disturbances())
      if (action->text().contains(part)) return action;
    return nullptr;
  }
  bool spanned(const QString& text) {
    window_->plots().showSheet(PlotDeck::kFlight);
    return eventually([&] {
      for (const PlotSpan& span : window_->plots().sheet(PlotDeck::kFlight).spans())
        if (span.text == text) return true;
      return false;
    });
  }
};

TEST_F(DisturbanceWindow, ABoardDrawnOverThePictureCoversTheCameraUntilItsCrossIsClicked) {
  open(false);
  ASSERT_NO_FATAL_FAILURE(takeOffByMouse());
  ASSERT_TRUE(eventually([this] { return usesCamera(0) && usesCamera(1); }));
  ASSERT_NO_FATAL_FAILURE(boardOverAll(1));
  EXPECT_TRUE(eventually([this] {
    return snapshot().cameras[1].boards == 1 && snapshot().cameras[1].centroids == 0 && !usesCamera(1);
  }));
  EXPECT_FALSE(window_->cameras().pane(1).boardButton()->isChecked()) << "one board a click";
  EXPECT_TRUE(spanned("Camera 2 covered"));
  EXPECT_TRUE(usesCamera(0));
  EXPECT_EQ(snapshot().phase, FlightPhase::kFlying);

  CameraView& on = view(1);
  const QPointF cross = on.toWidget(BoardEditor::handle(on.boards().boards[0]));
  QTest::mouseClick(&on, Qt::LeftButton, {}, cross.toPoint());
  EXPECT_TRUE(eventually([this] { return snapshot().cameras[1].boards == 0 && usesCamera(1); }));
}

TEST_F(DisturbanceWindow, ABoardCoversWhereverItIsDragged) {
  open(false);
  ASSERT_TRUE(eventually([this] { return usesCamera(0); }));
  CameraView& on = view(0);
  click(window_->cameras().pane(0).boardButton());
  drag(on, on.toWidget({5, 5}), on.toWidget({75, 470}));  // at the left edge: the helicopter is in the middle
  ASSERT_TRUE(eventually([this] { return snapshot().cameras[0].boards == 1; }));
  EXPECT_TRUE(usesCamera(0));
  const MarkerTrack marker = snapshot().cameras[0].track.markers[0];
  drag(on, on.toWidget({40, 240}), on.toWidget({marker.pixel.x(), 240}));
  EXPECT_TRUE(eventually([this] { return snapshot().cameras[0].centroids < snapshot().marker_count; }));
  disturbance(0, "away")->trigger();
  EXPECT_TRUE(eventually([this] { return snapshot().cameras[0].centroids == snapshot().marker_count; }));
}

TEST_F(DisturbanceWindow, FramesShowTheBoard) {
  open(true);
  ASSERT_TRUE(eventually([this] { return usesCamera(0); }));
  ASSERT_NO_FATAL_FAILURE(boardOverAll(0));
  ASSERT_TRUE(eventually([this] { return snapshot().cameras[0].centroids == 0; }));
  EXPECT_TRUE(eventually([this] {
    const QImage shown = view(0).grab().toImage();
    const QPointF middle = view(0).toWidget({320, 300});
    return shown.pixelColor(middle.toPoint()).lightness() > 220;
  }));
}

TEST_F(DisturbanceWindow, AKnockMovesTheCameraThatIsTrueAndIsSeenInThePlots) {
  open(false);
  ASSERT_TRUE(eventually([this] { return snapshot().cameras[1].has_truth; }));
  const RigidTransform before = snapshot().cameras[1].true_camera_from_world;
  QAction* knock = disturbance(1, "10 deg");
  ASSERT_NE(knock, nullptr);
  knock->trigger();
  ASSERT_TRUE(eventually([this] { return snapshot().cameras[1].knocks == 1; }));
  const Vector6d moved = cameraPerturbation(before, snapshot().cameras[1].true_camera_from_world);
  EXPECT_NEAR(moved.head<3>().norm(), toRadians(10.0), 1e-6);
  EXPECT_NEAR(moved.tail<3>().norm(), 0.20, 1e-6);
  EXPECT_TRUE(spanned("Camera 2 knocked"));
}

TEST_F(DisturbanceWindow, AGustPushesTheHelicopterAndIsSeenInThePlots) {
  open(false);
  ASSERT_NO_FATAL_FAILURE(takeOffByMouse());
  ASSERT_TRUE(eventually([this] { return snapshot().hovering; }));
  QAction* strong = nullptr;
  for (QAction* menu : window_->topBar().menuBar()->actions())
    for (QAction* action : menu->menu()->actions())
      if (action->text().startsWith("Strong gust")) strong = action;
  ASSERT_NE(strong, nullptr);
  const double before = snapshot().truth.world_from_body.translation.x();
  strong->trigger();
  EXPECT_TRUE(eventually([this] { return snapshot().gust_ordered; }));
  EXPECT_TRUE(eventually([&] { return snapshot().truth.world_from_body.translation.x() > before + 0.05; }));
  EXPECT_TRUE(spanned("gust"));
}

}  // namespace
}  // namespace helical
