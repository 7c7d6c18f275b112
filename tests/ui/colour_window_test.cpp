#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <QWheelEvent>

#include "tests/ui/window_fixture.h"
#include "ui/camera_pane.h"
#include "ui/camera_tools.h"
#include "ui/camera_view.h"
#include "ui/camera_wall.h"
#include "ui/colour_editor.h"
#include "ui/colour_tool.h"

namespace helical {
namespace {

class ColourWindow : public WindowTest {
 protected:
  CameraView& view(int camera) { return window_->cameras().pane(camera).view(); }
  QAction* tool(int camera, const QString& part) {
    for (QAction* action : window_->cameras().pane(camera).tools().actions())
      if (action->text().contains(part)) return action;
    return nullptr;
  }
  bool seesAll(int camera) {
    return eventually([this, camera] {
      const CameraSnapshot& state = snapshot().cameras[static_cast<std::size_t>(camera)];
      return state.centroids >= snapshot().marker_count && state.track.markers[0].selected;
    });
  }
  QPoint onBall(int camera) {
    const CameraTrack& track = snapshot().cameras[static_cast<std::size_t>(camera)].track;
    return view(camera).toWidget(track.markers[0].pixel).toPoint();
  }
};

TEST_F(ColourWindow, AClickOnABallProposesItsColourApplyFindsItUndoGoesBack) {
  RigConfig rig = shippedRig(true);
  open(rig);
  ASSERT_TRUE(seesAll(0));
  const ColourRange before = engine_->markerColour();
  tool(0, "Pick")->trigger();
  ColourEditor& editor = window_->colourTool().editor();
  ASSERT_TRUE(editor.isVisible());
  EXPECT_FALSE(editor.applyButton()->isEnabled()) << "nothing to apply yet";
  // The picture may still be one from before the helicopter came: numbers arrive sooner than pictures.
  ASSERT_TRUE(eventually([&] {
    QTest::mouseClick(&view(0), Qt::LeftButton, {}, onBall(0));
    return editor.range() != before;
  }));
  EXPECT_TRUE(view(1).masks().colour) << "previewed in every picture";
  EXPECT_EQ(view(1).masks().range, editor.range());
  EXPECT_EQ(engine_->markerColour(), before) << "not before Apply";

  click(editor.applyButton());
  EXPECT_EQ(engine_->markerColour(), editor.range());
  ASSERT_TRUE(eventually([this] { return snapshot().colours == 1; }));
  EXPECT_TRUE(seesAll(0)) << "the ball that was clicked is found by its own colour";

  click(editor.undoButton());
  EXPECT_EQ(engine_->markerColour(), before);
  EXPECT_FALSE(editor.undoButton()->isEnabled());
  editor.close();
  EXPECT_FALSE(view(1).masks().colour);
}

TEST_F(ColourWindow, AWrongRangeFindsNothingAndUndoBringsTheHelicopterBack) {
  open(true);
  ASSERT_TRUE(seesAll(0));
  tool(0, "Pick")->trigger();
  ColourEditor& editor = window_->colourTool().editor();
  editor.slider(0)->setValue(130);
  editor.slider(1)->setValue(150);
  click(editor.applyButton());
  EXPECT_TRUE(eventually([this] { return snapshot().cameras[0].centroids == 0; }));
  click(editor.undoButton());
  EXPECT_TRUE(seesAll(0));
}

TEST_F(ColourWindow, AClickOnTheGreyWallChangesNothing) {
  open(true);
  ASSERT_TRUE(seesAll(0));
  tool(0, "Pick")->trigger();
  const ColourRange before = window_->colourTool().editor().range();
  QTest::mouseClick(&view(0), Qt::LeftButton, {}, view(0).toWidget({12, 12}).toPoint());
  EXPECT_EQ(window_->colourTool().editor().range(), before);
}

TEST_F(ColourWindow, FramesAreLostAndNoiseIsAddedByTheTools) {
  open(false);
  ASSERT_TRUE(seesAll(1));
  const auto choose = [&](const QString& menu, const QString& text) {
    for (QAction* action : tool(1, menu)->menu()->actions())
      if (action->text().startsWith(text)) return action->trigger();
    FAIL() << menu.toStdString();
  };
  choose("Lose frames", "60");
  EXPECT_TRUE(eventually(
      [this] { return snapshot().cameras[1].lost_share == 0.6 && snapshot().cameras[1].dropped > 10; }));
  choose("Noise", "1.5");
  EXPECT_TRUE(eventually([this] { return snapshot().cameras[1].noise == 1.5; }));
  choose("Lose frames", "None");
  choose("Noise", "None");
  EXPECT_TRUE(eventually(
      [this] { return snapshot().cameras[1].lost_share == 0.0 && snapshot().cameras[1].noise == 0.0; }));
}

TEST_F(ColourWindow, ThePictureZoomsAndMoves) {
  open(true);
  ASSERT_TRUE(seesAll(0));
  CameraView& on = view(0);
  const QPoint mouse = onBall(0);
  const Eigen::Vector2d pixel = on.toImage(mouse);
  for (int i = 0; i < 6; ++i) {
    QWheelEvent wheel(mouse, on.mapToGlobal(mouse), {}, QPoint(0, 120), {}, {}, Qt::NoScrollPhase, false);
    QApplication::sendEvent(&on, &wheel);
  }
  EXPECT_GT(on.viewport().zoom(), 3.0);
  EXPECT_LT((on.toImage(mouse) - pixel).norm(), 0.01);
  QTest::mousePress(&on, Qt::LeftButton, {}, mouse);
  QTest::mouseMove(&on, mouse + QPoint(25, 10));
  QTest::mouseRelease(&on, Qt::LeftButton, {}, mouse + QPoint(25, 10));
  EXPECT_LT((on.toImage(mouse + QPointF(25, 10)) - pixel).norm(), 0.01);
  QTest::mouseDClick(&on, Qt::LeftButton, {}, mouse);
  EXPECT_FALSE(on.viewport().zoomed());
}

}  // namespace
}  // namespace helical
