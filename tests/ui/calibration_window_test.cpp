#include <QAction>
#include <QComboBox>
#include <QFile>
#include <QFileDialog>
#include <QLineEdit>
#include <QMessageBox>
#include <QTemporaryDir>
#include <QToolButton>

#include "engine/config/calibration_file.h"
#include "engine/config/resource_files.h"
#include "engine/config/rig_file.h"
#include "engine/geometry/camera_perturbation.h"
#include "tests/ui/window_fixture.h"
#include "ui/calibration_panel.h"
#include "ui/calibration_row.h"
#include "ui/camera_pane.h"
#include "ui/camera_tools.h"
#include "ui/camera_wall.h"
#include "ui/event_list.h"
#include "ui/event_panel.h"
#include "ui/panel_title.h"
#include "ui/plot_deck.h"
#include "ui/time_plots.h"

namespace helical {
namespace {

class CalibrationWindow : public WindowTest {
 protected:
  CameraStatus status() const { return snapshot().cameras[2].estimate.status; }
  bool admitted() {
    return eventually([this] { return status() == CameraStatus::kCalibrated; });
  }
  QString method() const {
    const char* name = snapshot().cameras[2].calibration_method;
    return name ? QString::fromUtf8(name) : QString();
  }
  /// As somebody does who opens the list and clicks an entry.
  void choose(const QString& name) {
    QComboBox* list = window_->calibration().methods();
    const int index = list->findText(name);
    ASSERT_GE(index, 0) << name.toStdString();
    list->setCurrentIndex(index);
    Q_EMIT list->textActivated(name);
  }
  const CalibrationRow& row() const { return window_->calibration().row(2); }
  /// As somebody does who types a name into the dialog that has opened, and presses Enter.
  void answerFileDialog(const QString& file) {
    QFileDialog* dialog = nullptr;
    ASSERT_TRUE(eventually([&] {
      dialog = window_->findChild<QFileDialog*>();
      return dialog != nullptr && dialog->isVisible();
    }));
    EXPECT_FALSE(dialog->isModal()) << "STOP must stay in reach of the mouse";
    auto* name = dialog->findChild<QLineEdit*>();
    ASSERT_NE(name, nullptr);
    name->setText(file);
    QTest::keyClick(name, Qt::Key_Return);
    ASSERT_TRUE(eventually([this] { return window_->findChild<QFileDialog*>() == nullptr; }));
  }
  bool announced(const QString& text) {
    return eventually([&] {
      for (int i = 0; i < window_->events().list().count(); ++i)
        if (window_->events().list().item(i)->text().contains(text)) return true;
      return false;
    });
  }
};

TEST_F(CalibrationWindow, CameraThreeFindsItsPlaceAndThePlotShowsHow) {
  open(calibratingRig(false));
  ASSERT_TRUE(admitted());
  EXPECT_TRUE(announced("Camera 3: calibrated"));
  const TickHistory& history = window_->plots().history();
  const int error = history.column(2, CameraColumn::kPositionError);
  ASSERT_TRUE(eventually([&] { return history.end() >= static_cast<std::int64_t>(snapshot().tick) - 1; }));
  EXPECT_NEAR(history.value(history.first(), error), 0.4, 1e-3) << "from its first guess";
  EXPECT_LT(history.value(history.end() - 1, error), 0.1);
  TimePlots& plots = window_->plots().sheet(PlotDeck::kCalibration);
  EXPECT_TRUE(plots.isVisible()) << "the sheet a newcomer sees first";
  EXPECT_TRUE(eventually([&] { return plots.pointCount(0, 0) > 10 && plots.pointCount(0, 1) > 10; }));
  const int bound = history.column(2, CameraColumn::kPositionBound);
  EXPECT_TRUE(eventually([&] { return history.value(history.end() - 1, bound) > 0.0; })) << "Cramer-Rao";
  EXPECT_TRUE(eventually([&] { return window_->calibration().state(2) == "Calibrated"; }));
  EXPECT_TRUE(eventually([&] {
    return window_->cameras().pane(2).title().badge().startsWith("Calibrated ") &&
           window_->cameras().pane(2).title().badge().endsWith(" mm");
  }));
}

TEST_F(CalibrationWindow, AnotherMethodIsChosenFromTheListWhileFlying) {
  open(calibratingRig(false));
  ASSERT_NO_FATAL_FAILURE(takeOffByMouse());
  ASSERT_TRUE(admitted());
  EXPECT_EQ(method(), "particle-filter");
  for (const QString name : {"growing-gauss-newton", "gauss-newton", "particle-filter"}) {
    ASSERT_NO_FATAL_FAILURE(choose(name));
    EXPECT_TRUE(eventually([&] { return method() == name; })) << name.toStdString();
    EXPECT_TRUE(announced("calibrates anew by " + name));
    EXPECT_EQ(snapshot().phase, FlightPhase::kFlying) << "the flight goes on";
    EXPECT_TRUE(snapshot().pose_known);
  }
  EXPECT_TRUE(admitted()) << "and comes back when it has learnt";
  EXPECT_TRUE(eventually([this] { return usesCamera(2); }));
  EXPECT_EQ(engine_->lostTicks(), 0U);
}

TEST_F(CalibrationWindow, FliesOnTheNewCameraWithCameraTwoHidden) {
  open(calibratingRig(false));
  ASSERT_NO_FATAL_FAILURE(takeOffByMouse());
  ASSERT_TRUE(admitted());
  click(window_->cameras().pane(1).hideButton());
  EXPECT_TRUE(eventually([this] { return !usesCamera(1) && usesCamera(0) && usesCamera(2); }));
  const std::uint64_t since = snapshot().tick;
  EXPECT_TRUE(eventually([&] { return snapshot().tick > since + 120; }));
  EXPECT_EQ(snapshot().phase, FlightPhase::kFlying);
  EXPECT_EQ(snapshot().safety, SafetyState::kNormal);
  EXPECT_TRUE(announced("Camera 2: hidden by the operator"));
}

TEST_F(CalibrationWindow, RestartForgetsWhatWasLearnt) {
  open(calibratingRig(false));
  ASSERT_TRUE(admitted());
  QToolButton* restart = row().restartButton();
  ASSERT_TRUE(restart->isVisible());
  // The teacher is covered: what was forgotten cannot be learnt again.
  click(window_->cameras().pane(0).hideButton());
  ASSERT_TRUE(eventually([this] { return window_->cameras().pane(0).cameraHidden(); }));
  click(restart);
  EXPECT_TRUE(eventually([this] { return status() == CameraStatus::kCalibrating; }));
  EXPECT_TRUE(announced("Camera 3: calibrates anew by particle-filter"));
  click(window_->cameras().pane(0).hideButton());
  EXPECT_TRUE(admitted());
}

TEST_F(CalibrationWindow, CameraThreeIsKnockedInFlightAndFindsItsNewPlace) {
  open(calibratingRig(false));
  ASSERT_NO_FATAL_FAILURE(takeOffByMouse());
  ASSERT_TRUE(admitted());
  ASSERT_TRUE(eventually([this] { return usesCamera(2); }));
  QAction* knock = nullptr;
  for (QAction* action : window_->cameras().pane(2).tools().disturbances())
    if (action->text().contains("10 deg")) knock = action;
  ASSERT_NE(knock, nullptr);
  knock->trigger();
  ASSERT_TRUE(eventually([this] { return snapshot().cameras[2].knocks_found > 0; }));
  EXPECT_TRUE(admitted()) << "its new place";
  EXPECT_TRUE(eventually([this] { return usesCamera(2); }));
  const CameraSnapshot& camera = snapshot().cameras[2];
  EXPECT_LT(cameraPerturbation(camera.true_camera_from_world, camera.estimate.camera_from_world).tail<3>().norm(),
            0.05);
  EXPECT_EQ(snapshot().phase, FlightPhase::kFlying);
}

TEST_F(CalibrationWindow, FrozenItLearnsNoMoreUntilResumed) {
  open(calibratingRig(false));
  ASSERT_TRUE(admitted());
  click(row().freezeButton());
  ASSERT_TRUE(eventually([this] { return snapshot().cameras[2].frozen; }));
  EXPECT_TRUE(announced("Camera 3: frozen by the operator"));
  ASSERT_TRUE(eventually([this] { return row().freezeButton()->text() == "Resume"; }));
  EXPECT_EQ(row().state(), "Calibrated, frozen");
  const Eigen::Vector3d before = snapshot().cameras[2].estimate.camera_from_world.translation;
  const std::uint64_t tick = snapshot().tick;
  ASSERT_TRUE(eventually([&] { return snapshot().tick > tick + 60; }));
  EXPECT_EQ(snapshot().cameras[2].estimate.camera_from_world.translation, before);
  click(row().freezeButton());
  EXPECT_TRUE(eventually([this] { return !snapshot().cameras[2].frozen; }));
  EXPECT_TRUE(announced("Camera 3: learns on"));
  EXPECT_TRUE(eventually(
      [&] { return snapshot().cameras[2].estimate.camera_from_world.translation != before; }));
}

TEST_F(CalibrationWindow, ACameraThatKnowsNothingIsNotAcceptedAndItIsSaidWhy) {
  open(shippedRig(false));  // camera 3 without even a guess
  // What it had learnt by now is forgotten, and without the others it cannot learn it again.
  for (const int camera : {0, 1}) click(window_->cameras().pane(camera).hideButton());
  ASSERT_TRUE(eventually([this] { return snapshot().cameras[0].hidden && snapshot().cameras[1].hidden; }));
  click(row().restartButton());
  ASSERT_TRUE(announced("Camera 3: calibrates anew"));
  ASSERT_NE(status(), CameraStatus::kCalibrated);
  ASSERT_TRUE(eventually([this] { return row().acceptButton()->isEnabled(); }));
  click(row().acceptButton());
  EXPECT_TRUE(announced("Camera 3: order refused: it does not know its place"));
  EXPECT_NE(status(), CameraStatus::kCalibrated);
}

TEST_F(CalibrationWindow, ARefinementOfAllCamerasIsAskedForAndAnswered) {
  open(calibratingRig(false));
  ASSERT_TRUE(eventually([this] { return snapshot().tick > 0; }));
  click(window_->calibration().refineButton());
  EXPECT_TRUE(announced("Refinement refused: too little was seen by two cameras at a time yet"));
}

TEST_F(CalibrationWindow, PlacesAreSavedAndLoaded) {
  QTemporaryDir folder;
  const QString file = folder.filePath("places.toml");
  open(calibratingRig(false));
  ASSERT_TRUE(admitted());
  click(row().freezeButton());  // so that what is saved stays so
  ASSERT_TRUE(eventually([this] { return snapshot().cameras[2].frozen; }));
  const Eigen::Vector3d learnt = snapshot().cameras[2].estimate.camera_from_world.translation;
  click(window_->calibration().saveButton());
  ASSERT_NO_FATAL_FAILURE(answerFileDialog(file));
  ASSERT_TRUE(eventually([&] { return QFile::exists(file); }));
  ASSERT_TRUE(eventually([this] { return row().freezeButton()->text() == "Resume"; }));
  click(row().freezeButton());
  ASSERT_TRUE(eventually([this] { return !snapshot().cameras[2].frozen; }));
  // Forgotten, and without a teacher to learn it from again.
  click(window_->cameras().pane(0).hideButton());
  ASSERT_TRUE(eventually([this] { return snapshot().cameras[0].hidden; }));
  click(row().restartButton());
  ASSERT_TRUE(eventually([this] { return status() == CameraStatus::kCalibrating; }));

  click(window_->calibration().loadButton());
  ASSERT_NO_FATAL_FAILURE(answerFileDialog(file));
  EXPECT_TRUE(admitted());
  EXPECT_TRUE(announced("Camera 3: believed to stand where the loaded calibration says"));
  EXPECT_LT((snapshot().cameras[2].estimate.camera_from_world.translation - learnt).norm(), 1e-9);
}

TEST_F(CalibrationWindow, ThePlaceOfOneCameraIsSavedAndLoadedFromItsRow) {
  QTemporaryDir folder;
  const QString file = folder.filePath("place.toml");
  open(calibratingRig(false));
  ASSERT_TRUE(eventually([this] { return snapshot().tick > 0; }));
  ASSERT_TRUE(eventually([this] { return row().saveButton()->isEnabled(); })) << "once it knows its place";
  ASSERT_TRUE(admitted());
  click(row().saveButton());
  ASSERT_NO_FATAL_FAILURE(answerFileDialog(file));
  ASSERT_TRUE(eventually([&] { return QFile::exists(file); }));
  const SavedCalibration saved = loadCalibration(file.toStdString());
  ASSERT_EQ(saved.cameras.size(), 1U);
  EXPECT_EQ(saved.cameras[0].label, "3");
  click(window_->cameras().pane(0).hideButton());
  ASSERT_TRUE(eventually([this] { return snapshot().cameras[0].hidden; }));
  click(row().restartButton());
  ASSERT_TRUE(eventually([this] { return status() == CameraStatus::kCalibrating; }));
  EXPECT_TRUE(eventually([this] { return !row().saveButton()->isEnabled(); }));
  click(row().loadButton());
  ASSERT_NO_FATAL_FAILURE(answerFileDialog(file));
  EXPECT_TRUE(admitted());
  EXPECT_LT((snapshot().cameras[2].estimate.camera_from_world.translation -
             saved.cameras[0].camera_from_world.translation)
                .norm(),
            1e-9);
}

TEST_F(CalibrationWindow, ThePlotShowsDeOfEachLabellingAndTheRowNamesTheOneThatWasTaken) {
  open(calibratingRig(false));
  ASSERT_TRUE(eventually([this] { return snapshot().cameras[2].labellings.count >= 2; }));
  window_->plots().showSheet(PlotDeck::kLabels);
  TimePlots& plots = window_->plots().sheet(PlotDeck::kLabels);
  ASSERT_TRUE(eventually([&] { return plots.pointCount(0, 0) > 10 && plots.pointCount(0, 1) > 10; }))
      << "camera 3 comes first: it is the one that learns";
  EXPECT_EQ(plots.note(0), "");
  EXPECT_NE(plots.note(1), "") << "no method here chooses by misfit";
  ASSERT_TRUE(eventually([this] { return !row().labelling().isEmpty(); }));
  EXPECT_EQ(row().labelling().count('-'), snapshot().marker_count - 1);
  choose("joint");
  EXPECT_TRUE(eventually([&] { return plots.pointCount(1, 0) > 5; }));
}

TEST_F(CalibrationWindow, AMethodWithoutParticlesLeavesANoteInTheirPlot) {
  RigConfig rig = calibratingRig(false);
  rig.calibrator = "growing-gauss-newton";
  open(rig);
  ASSERT_TRUE(eventually([this] { return window_->plots().history().end() > 30; }));
  TimePlots& plots = window_->plots().sheet(PlotDeck::kCalibration);
  EXPECT_TRUE(eventually([&] { return plots.note(1) == "Only for particle filters"; }));
  choose("particle-filter");
  EXPECT_TRUE(eventually([&] { return plots.note(1).isEmpty(); }));
}

TEST_F(CalibrationWindow, AFileThatIsNoCalibrationChangesNothingAndIsSaidToBeNone) {
  QTemporaryDir folder;
  const QString file = folder.filePath("none.toml");
  QFile none(file);
  ASSERT_TRUE(none.open(QIODevice::WriteOnly));
  none.write("colour = 3\n");
  none.close();
  open(calibratingRig(false));
  ASSERT_TRUE(eventually([this] { return snapshot().tick > 0; }));
  click(window_->calibration().loadButton());
  ASSERT_NO_FATAL_FAILURE(answerFileDialog(file));
  EXPECT_TRUE(eventually([this] {
    const auto* notice = window_->findChild<QMessageBox*>();
    return notice != nullptr && notice->windowTitle() == "Calibration not loaded";
  }));
  EXPECT_FALSE(window_->findChild<QMessageBox*>()->isModal());
}

TEST_F(CalibrationWindow, ARigWithKnownPlacesHasNothingToChooseUntilACameraIsKnocked) {
  RigConfig rig = loadRig(resourceFolder() / "rigs" / "calibrated.toml");
  rig.simulation.images = false;
  rig.simulation.gust_factor = 0.0;
  rig.calibrator = "particle-filter";
  open(rig);
  EXPECT_FALSE(window_->calibration().methods()->isEnabled());
  window_->plots().showSheet(PlotDeck::kCalibration);
  EXPECT_TRUE(window_->plots().sheet(PlotDeck::kCalibration).isVisible());
  EXPECT_EQ(window_->calibration().state(0), "");

  ASSERT_NO_FATAL_FAILURE(takeOffByMouse());
  for (QAction* action : window_->cameras().pane(0).tools().disturbances())
    if (action->text().contains("10 deg")) action->trigger();
  EXPECT_TRUE(eventually([this] { return snapshot().cameras[0].knocks_found > 0; }));
  EXPECT_TRUE(eventually([this] { return !window_->calibration().state(0).isEmpty(); }));
  EXPECT_TRUE(window_->calibration().methods()->isEnabled());
  EXPECT_TRUE(
      eventually([this] { return snapshot().cameras[0].estimate.status == CameraStatus::kCalibrated; }));
}

}  // namespace
}  // namespace helical
