#include <Eigen/Geometry>
#include <QDir>
#include <QPushButton>
#include <QSet>
#include <QToolButton>
#include <cmath>

#include "tests/ui/window_fixture.h"
#include "ui/alarm_bar.h"
#include "ui/camera_pane.h"
#include "ui/camera_view.h"
#include "ui/camera_wall.h"
#include "ui/plot_deck.h"
#include "ui/preflight_popup.h"
#include "ui/scene_view.h"
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
