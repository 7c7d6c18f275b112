#include <Eigen/Geometry>
#include <QDir>
#include <QDockWidget>
#include <QPushButton>
#include <QSet>
#include <QToolButton>
#include <cmath>

#include "engine/config/resource_files.h"
#include "tests/ui/window_fixture.h"
#include "ui/alarm_bar.h"
#include "ui/camera_pane.h"
#include "ui/camera_tools.h"
#include "ui/camera_view.h"
#include "ui/camera_wall.h"
#include "ui/catalogue.h"
#include "ui/hold_button.h"
#include "ui/plot_deck.h"
#include "ui/preflight_popup.h"
#include "ui/scene_view.h"
#include "ui/theme.h"
#include "ui/top_bar.h"

namespace helical {
namespace {

int colorsIn(const QImage& image) {
  QSet<QRgb> colors;
  for (int y = 0; y < image.height(); y += 2)
    for (int x = 0; x < image.width(); x += 2) colors.insert(image.pixel(x, y));
  return static_cast<int>(colors.size());
}

class WindowPictures : public WindowTest {
 protected:
  void save(const QString& name) {
    const QString folder = QStringLiteral(HELICAL_PICTURE_DIR);
    ASSERT_TRUE(QDir().mkpath(folder));
    ASSERT_TRUE(window_->grab().save(folder + "/" + name + ".png"));
  }
  void waitForScene() {
    const int frames = window_->scene().renderedFrames();
    ASSERT_TRUE(eventually([&] { return window_->scene().renderedFrames() >= frames + 3; }));
  }
};

TEST_F(WindowPictures, TheStatesOfAFlight) {
  open(true);
  ASSERT_TRUE(eventually([this] { return window_->firstImageNs().has_value(); }));
  EXPECT_GT(*window_->firstImageNs(), 0);
  ASSERT_TRUE(eventually([this] { return snapshot().pose_known; }));
  ASSERT_NO_FATAL_FAILURE(waitForScene());
  save("start");

  ASSERT_NO_FATAL_FAILURE(takeOffByMouse());
  ASSERT_TRUE(eventually([this] { return snapshot().hovering; }));
  ASSERT_NO_FATAL_FAILURE(waitForScene());
  save("hover");
  EXPECT_GT(colorsIn(window_->cameras().pane(0).grab().toImage()), 500) << "a picture, not a blank";
  EXPECT_GT(colorsIn(window_->scene().grab().toImage()), 200);

  click(window_->cameras().pane(1).hideButton());
  ASSERT_TRUE(eventually([this] { return window_->cameras().pane(1).cameraHidden(); }));
  ASSERT_NO_FATAL_FAILURE(clickView("Iso view"));
  ASSERT_NO_FATAL_FAILURE(waitForScene());
  save("camera_2_hidden");

  press(Qt::Key_Escape);
  ASSERT_TRUE(eventually([this] { return window_->topBar().readiness() == "Cut"; }));
  ASSERT_NO_FATAL_FAILURE(clickView("Top view"));
  ASSERT_NO_FATAL_FAILURE(waitForScene());
  save("stopped");
}

TEST_F(WindowPictures, ACameraThatLearnsABoardAndAnAlarm) {
  open(calibratingRig(true));
  ASSERT_TRUE(
      eventually([this] { return snapshot().cameras[2].estimate.status == CameraStatus::kCalibrated; }));
  ASSERT_NO_FATAL_FAILURE(takeOffByMouse());
  CameraView& view = window_->cameras().pane(1).view();
  click(window_->cameras().pane(1).boardButton());
  QTest::mousePress(&view, Qt::LeftButton, {}, view.toWidget({150, 60}).toPoint());
  QTest::mouseMove(&view, view.toWidget({480, 380}).toPoint());
  QTest::mouseRelease(&view, Qt::LeftButton, {}, view.toWidget({480, 380}).toPoint());
  ASSERT_TRUE(eventually([this] { return snapshot().cameras[1].centroids == 0; }));
  ASSERT_NO_FATAL_FAILURE(waitForScene());
  save("board");
  window_->plots().showSheet(PlotDeck::kFeatures);
  click(window_->topBar().readinessButton());
  ASSERT_NO_FATAL_FAILURE(waitForScene());
  save("features");
  window_->topBar().preflight().close();

  for (const int camera : {0, 2}) click(window_->cameras().pane(camera).hideButton());
  ASSERT_TRUE(eventually([this] { return window_->alarms().unacknowledged() > 0; }));
  ASSERT_NO_FATAL_FAILURE(waitForScene());
  save("alarm");
}

TEST_F(WindowPictures, PanelsLayoutsMasksAndTheLightTheme) {
  open(calibratingRig(true));
  ASSERT_NO_FATAL_FAILURE(takeOffByMouse());
  ASSERT_TRUE(eventually([this] { return snapshot().hovering; }));
  window_->findChild<QDockWidget*>("Plan")->raise();
  ASSERT_NO_FATAL_FAILURE(clickView("Iso view"));
  ASSERT_NO_FATAL_FAILURE(waitForScene());
  save("plan");
  window_->findChild<QDockWidget*>("Gains")->raise();
  const auto showMasks = [this](bool shown) {
    for (QAction* action : window_->cameras().pane(0).tools().actions())
      if (action->text().contains("mask")) action->setChecked(shown);
  };
  showMasks(true);
  window_->plots().showSheet(PlotDeck::kLatency);
  window_->scene().lookThrough(cameraId(1));
  ASSERT_NO_FATAL_FAILURE(waitForScene());
  save("gains_masks_latency");
  showMasks(false);

  window_->arrange(DockLayouts::Layout::kCalibrate);
  for (QAction* action : window_->cameras().pane(0).tools().disturbances())
    if (action->text().contains("10 deg")) action->trigger();
  ASSERT_TRUE(eventually([this] { return snapshot().cameras[0].knocks_found > 0; }));
  ASSERT_NO_FATAL_FAILURE(clickView("Iso view"));
  ASSERT_NO_FATAL_FAILURE(waitForScene());
  save("knocked_camera");

  theme::apply(*qApp, theme::Theme::kLight);
  window_->arrange(DockLayouts::Layout::kFly);
  window_->plots().showSheet(PlotDeck::kFlight);
  ASSERT_NO_FATAL_FAILURE(waitForScene());
  save("light_theme");
  EXPECT_GT(window_->grab().toImage().pixelColor(5, window_->height() - 8).lightness(), 180);
  theme::apply(*qApp, theme::Theme::kDark);
}

TEST_F(WindowPictures, German) {
  Catalogue catalogue;
  ASSERT_TRUE(
      catalogue.loadFor({"de"}, QString::fromStdString((resourceFolder() / "translations").string())));
  QCoreApplication::installTranslator(&catalogue);
  open(true);
  ASSERT_TRUE(eventually([this] { return snapshot().pose_known; }));
  ASSERT_NO_FATAL_FAILURE(waitForScene());
  EXPECT_EQ(window_->topBar().takeOffButton()->text(), "Starten");
  save("german");
  window_->detach();
  window_.reset();
  QCoreApplication::removeTranslator(&catalogue);
}

TEST_F(WindowPictures, SixteenCamerasWithoutImages) {
  RigConfig rig = shippedRig(false);
  const CameraConfig first = rig.cameras.front();
  rig.cameras.clear();
  rig.simulation.true_camera_from_world.assign(kMaxCameras, std::nullopt);
  for (int i = 0; i < kMaxCameras; ++i) {
    CameraConfig camera = first;
    camera.label = std::to_string(i + 1);
    camera.name = "Camera " + camera.label;
    RigidTransform turned;
    turned.rotation = Eigen::AngleAxisd(2.0 * M_PI * i / kMaxCameras, Eigen::Vector3d::UnitZ());
    camera.camera_from_world = *first.camera_from_world * turned;
    rig.cameras.push_back(camera);
  }
  open(rig);
  ASSERT_TRUE(eventually([this] { return snapshot().pose_known && usesCamera(kMaxCameras - 1); }));
  ASSERT_NO_FATAL_FAILURE(clickView("Iso view"));
  ASSERT_NO_FATAL_FAILURE(waitForScene());
  save("sixteen_cameras");
}

}  // namespace
}  // namespace helical
