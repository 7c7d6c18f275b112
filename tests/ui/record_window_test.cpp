#include <QLabel>
#include <QTemporaryDir>

#include "engine/config/plan_file.h"
#include "engine/config/resource_files.h"
#include "engine/config/text_file.h"
#include "engine/session/flight_playback.h"
#include "tests/ui/window_fixture.h"
#include "ui/record_label.h"

namespace helical {
namespace {

class WindowRecord : public WindowTest {
 protected:
  QString label() const { return window_->findChild<RecordLabel*>()->text(); }
  void pressCtrlR() {
    window_->activateWindow();
    ASSERT_TRUE(eventually([this] { return window_->isActiveWindow(); }));
    QTest::keyClick(window_->windowHandle(), Qt::Key_R, Qt::ControlModifier);
  }
  QTemporaryDir folder_;
  std::unique_ptr<Recorder> recorder_;  ///< ends after window and engine
};

TEST_F(WindowRecord, CtrlRRecordsThePicturesFromThenOnAndNoMore) {
  const std::filesystem::path file = folder_.filePath("flight.mcap").toStdString();
  SessionSettings settings;
  settings.rig = shippedRig(true);
  settings.rig_text = readTextFile(settings.rig.path, "rig file");
  settings.plan_text = readTextFile(planPath("hover"), "flight plan");
  settings.plan = hoverWithoutEnd();
  settings.realtime = true;
  settings.images.assign(settings.rig.cameras.size(), {ImageQuality::kJpeg, 0.0, false});
  recorder_ = std::make_unique<Recorder>(file, settings, Recorder::WhenFull::kDrop);
  ASSERT_NO_FATAL_FAILURE(open(settings.rig, false, recorder_.get()));
  ASSERT_TRUE(eventually([&] { return label() == "\u25CF recorded"; }));
  pressCtrlR();
  ASSERT_TRUE(eventually([&] { return label().contains("pictures"); }));
  EXPECT_TRUE(recorder_->recordsImages());
  const TimeNs begin = snapshot().time;
  ASSERT_TRUE(eventually([&] { return snapshot().time > begin + kNanosecondsPerSecond; }));
  pressCtrlR();
  ASSERT_TRUE(eventually([&] { return !label().contains("pictures"); }));
  EXPECT_FALSE(recorder_->recordsImages());
  TearDown();
  recorder_->finish();
  FlightPlayback playback(file, std::make_shared<ManualClock>());
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(playback.hasImages(cameraId(i))) << i;
}

TEST_F(WindowRecord, WithoutARecordItSaysSo) {
  ASSERT_NO_FATAL_FAILURE(open(true));
  ASSERT_TRUE(eventually([&] { return label() == "not recorded"; }));
  pressCtrlR();
  QTest::qWait(50);
  EXPECT_EQ(label(), "not recorded");
}

}  // namespace
}  // namespace helical
