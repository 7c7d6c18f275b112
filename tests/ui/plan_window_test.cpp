#include <QDoubleSpinBox>
#include <QPushButton>
#include <QTableWidget>

#include "engine/geometry/rotation.h"
#include "tests/ui/window_fixture.h"
#include "ui/attitude_indicator.h"
#include "ui/plan_editor.h"
#include "ui/scene_view.h"
#include "ui/tuning_editor.h"

namespace helical {
namespace {

FlightPlan tour() {
  FlightPlan plan;
  plan.waypoints = {{{0.0, 0.0, 0.6}, 0.0, 1.0, 0.25}, {{0.4, -0.2, 0.8}, 0.5, 2.0, 0.3}};
  return plan;
}

TEST(PlanEditor, AnEditIsADraftUntilItIsApplied) {
  PlanEditor editor;
  editor.setPlan(tour());
  EXPECT_FALSE(editor.applyButton()->isEnabled());
  FlightPlan applied;
  int times = 0;
  QObject::connect(&editor, &PlanEditor::applyRequested, [&](const FlightPlan& plan) {
    applied = plan;
    ++times;
  });
  editor.table().item(1, 0)->setText("-0.35");
  editor.table().item(1, 3)->setText("90");
  EXPECT_DOUBLE_EQ(editor.draft().waypoints[1].position_above_pad.x(), -0.35);
  EXPECT_EQ(times, 0);
  editor.applyButton()->click();
  EXPECT_EQ(times, 1);
  EXPECT_DOUBLE_EQ(applied.waypoints[1].position_above_pad.x(), -0.35);
  EXPECT_NEAR(applied.waypoints[1].yaw, 1.5708, 1e-4);
  EXPECT_DOUBLE_EQ(applied.waypoints[0].position_above_pad.z(), 0.6) << "what was not touched stays";
}

TEST(PlanEditor, SaysWhatIsWrongAndKeepsApplyOff) {
  PlanEditor editor;
  editor.setPlan(tour());
  editor.table().item(1, 2)->setText("0.02");
  EXPECT_TRUE(editor.problem().contains("waypoint 2"));
  EXPECT_FALSE(editor.applyButton()->isEnabled());
  editor.table().item(1, 2)->setText("high");
  EXPECT_EQ(editor.table().item(1, 2)->text(), "0.02") << "no number goes back";
  editor.revertButton()->click();
  EXPECT_TRUE(editor.problem().isEmpty());
  EXPECT_DOUBLE_EQ(editor.draft().waypoints[1].position_above_pad.z(), 0.8);
}

TEST(PlanEditor, AddsAndRemovesWaypointsButKeepsOne) {
  PlanEditor editor;
  editor.setPlan(tour());
  editor.table().selectRow(0);
  editor.addButton()->click();
  ASSERT_EQ(editor.draft().waypoints.size(), 3U);
  EXPECT_DOUBLE_EQ(editor.draft().waypoints[2].position_above_pad.y(), -0.2) << "behind the selected one";
  editor.removeButton()->click();
  editor.removeButton()->click();
  EXPECT_EQ(editor.draft().waypoints.size(), 1U);
  EXPECT_FALSE(editor.removeButton()->isEnabled());
}

TEST(PlanEditor, APlanFromElsewhereDoesNotTakeAnEditAway) {
  PlanEditor editor;
  editor.setPlan(tour());
  editor.moveWaypoint(1, {0.1, 0.2, 0.9});
  editor.setPlan(FlightPlan{});
  ASSERT_EQ(editor.draft().waypoints.size(), 2U);
  EXPECT_EQ(editor.draft().waypoints[1].position_above_pad, Eigen::Vector3d(0.1, 0.2, 0.9));
}

TEST(TuningEditor, ChangesAreOneChange) {
  const ControllerOptions rig;
  TuningEditor editor(rig);
  ControllerOptions applied;
  int times = 0;
  QObject::connect(&editor, &TuningEditor::applyRequested, [&](const ControllerOptions& control) {
    applied = control;
    ++times;
  });
  EXPECT_FALSE(editor.applyButton()->isEnabled());
  editor.number("position_p")->setValue(1.4);
  editor.number("trim_roll")->setValue(-0.05);
  EXPECT_EQ(times, 0);
  editor.applyButton()->click();
  EXPECT_EQ(times, 1);
  EXPECT_DOUBLE_EQ(applied.position_p, 1.4);
  EXPECT_DOUBLE_EQ(applied.trim_roll, -0.05);
  EXPECT_EQ(applied.position_d, rig.position_d) << "to the last bit, not as rounded for display";
  editor.setControl(applied);
  EXPECT_FALSE(editor.applyButton()->isEnabled());
  editor.defaultsButton()->click();
  EXPECT_EQ(editor.draft().position_p, rig.position_p);
}

TEST(TuningEditor, NothingLeavesItsSafeRange) {
  TuningEditor editor{ControllerOptions{}};
  for (const ControllerKey& key : controllerKeys()) {
    QDoubleSpinBox* number = editor.number(key.name);
    ASSERT_NE(number, nullptr) << key.name;
    number->setValue(1e9);
    EXPECT_NEAR(number->value(), key.highest, 1e-9) << key.name;
    number->setValue(-1e9);
    EXPECT_NEAR(number->value(), key.lowest, 1e-9) << key.name;
    EXPECT_FALSE(number->accessibleName().isEmpty());
  }
}

class PlanWindow : public WindowTest {
 protected:
  bool drawn() {
    const int frames = window_->scene().renderedFrames();
    return eventually([&] { return window_->scene().renderedFrames() >= frames + 3; });
  }
};

TEST_F(PlanWindow, AWaypointDraggedInTheSceneIsFlownAfterApply) {
  open(false);
  ASSERT_NO_FATAL_FAILURE(takeOffByMouse());
  ASSERT_TRUE(eventually([this] { return snapshot().hovering; }));
  ASSERT_NO_FATAL_FAILURE(clickView("Iso view"));
  ASSERT_TRUE(drawn());
  SceneView& scene = window_->scene();
  const auto from = scene.waypointPosition(0);
  ASSERT_TRUE(from);
  const QPoint start = from->toPoint(), end = start + QPoint(60, 10);
  QTest::mousePress(&scene, Qt::LeftButton, {}, start);
  QTest::mouseMove(&scene, start + QPoint(20, 4));
  QTest::mouseMove(&scene, end);
  QTest::mouseRelease(&scene, Qt::LeftButton, {}, end);
  const Eigen::Vector3d wanted = window_->plan().draft().waypoints[0].position_above_pad;
  EXPECT_GT(wanted.head<2>().norm(), 0.05);
  EXPECT_NEAR(wanted.z(), engine_->plan().waypoints[0].position_above_pad.z(), 1e-6) << "over the ground";
  EXPECT_EQ(snapshot().plans, 0U) << "not before Apply";
  ASSERT_TRUE(drawn());
  EXPECT_LT((*scene.waypointPosition(0) - QPointF(end)).manhattanLength(), 4.0) << "it stays under the mouse";

  click(window_->plan().applyButton());
  ASSERT_TRUE(eventually([this] { return snapshot().plans == 1; }));
  EXPECT_TRUE(eventually(
      [&] { return (snapshot().set_point.position_in_world.head<2>() - wanted.head<2>()).norm() < 0.01; }));
  EXPECT_EQ(snapshot().phase, FlightPhase::kFlying);
}

TEST_F(PlanWindow, GainsAreAppliedInFlight) {
  open(false);
  ASSERT_NO_FATAL_FAILURE(takeOffByMouse());
  window_->gains().number("yaw_p")->setValue(1.1);
  window_->gains().number("position_d")->setValue(2.3);
  click(window_->gains().applyButton());
  ASSERT_TRUE(eventually([this] { return snapshot().controls == 1; }));
  EXPECT_DOUBLE_EQ(engine_->control().yaw_p, 1.1);
  EXPECT_FALSE(window_->gains().applyButton()->isEnabled());
  EXPECT_EQ(snapshot().phase, FlightPhase::kFlying);
}

TEST_F(PlanWindow, TheAttitudeIsTheHelicopters) {
  open(false);
  ASSERT_TRUE(eventually([this] { return window_->attitude().known(); }));
  EXPECT_NEAR(window_->attitude().rollDeg(), 0.0, 3.0) << "it stands on its pad";
  EXPECT_NEAR(window_->attitude().pitchDeg(), 0.0, 3.0);
  // Nobody puts it down with its nose quite along x.
  ASSERT_TRUE(snapshot().has_truth);
  EXPECT_NEAR(window_->attitude().yawDeg(), toDegrees(yawOf(snapshot().truth.world_from_body.rotation)), 3.0);
}

TEST_F(PlanWindow, TheSceneIsSeenThroughACamera) {
  open(false);
  ASSERT_TRUE(eventually([this] { return snapshot().pose_known; }));
  window_->scene().lookThrough(cameraId(1));
  ASSERT_TRUE(drawn());
  const RigidTransform camera = snapshot().cameras[1].estimate.camera_from_world;
  const SceneFrame& frame = window_->scene().lastFrame();
  EXPECT_LT((frame.eye - camera.inverseTranslation()).norm(), 1e-9);
  const Eigen::Vector3d along = (camera * frame.focus).normalized();
  EXPECT_NEAR(along.z(), 1.0, 1e-9);
  ASSERT_NO_FATAL_FAILURE(clickView("Top view"));
  ASSERT_TRUE(drawn());
  EXPECT_GT((window_->scene().lastFrame().eye - camera.inverseTranslation()).norm(), 0.5);
}

}  // namespace
}  // namespace helical
