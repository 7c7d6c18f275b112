#include <QPushButton>
#include <QToolButton>
#include <cstdio>

#include "tests/ui/window_fixture.h"
#include "ui/alarm_bar.h"
#include "ui/camera_pane.h"
#include "ui/camera_wall.h"

namespace helical {
namespace {

EngineEvent eventAt(double time_s, Severity severity, const char* text) {
  EngineEvent event;
  event.time = fromSeconds(time_s);
  event.severity = severity;
  std::snprintf(event.text.data(), event.text.size(), "%s", text);
  return event;
}

TEST(AlarmBar, OnlyDangerIsAnAlarm) {
  QWidget window;
  AlarmBar bar(&window);
  bar.add(eventAt(1.0, Severity::kCaution, "Camera 2 hidden"));
  EXPECT_EQ(bar.unacknowledged(), 0);
  bar.add(eventAt(2.0, Severity::kDanger, "No pose"));
  EXPECT_EQ(bar.unacknowledged(), 1);
  EXPECT_EQ(bar.text(), "No pose");
  EXPECT_FALSE(bar.isHidden());
}

TEST(AlarmBar, TheSameDangerComesBackAfterHalfAMinuteOnly) {
  QWidget window;
  AlarmBar bar(&window);
  bar.add(eventAt(10.0, Severity::kDanger, "No pose"));
  bar.acknowledge();
  EXPECT_TRUE(bar.isHidden());
  bar.add(eventAt(39.0, Severity::kDanger, "No pose"));
  EXPECT_TRUE(bar.isHidden());
  bar.add(eventAt(39.5, Severity::kDanger, "Rotors cut, latched"));
  EXPECT_EQ(bar.text(), "Rotors cut, latched") << "another one comes at once";
  bar.add(eventAt(41.0, Severity::kDanger, "No pose"));
  EXPECT_EQ(bar.unacknowledged(), 2);
}

TEST_F(WindowTest, LosingThePoseInFlightRaisesAnAlarmUntilItIsAcknowledged) {
  open(false);
  ASSERT_NO_FATAL_FAILURE(takeOffByMouse());
  AlarmBar& alarms = window_->alarms();
  EXPECT_FALSE(alarms.isVisible());
  for (int i = 0; i < 3; ++i) click(window_->cameras().pane(i).hideButton());
  ASSERT_TRUE(eventually([&] { return alarms.isVisible(); }));
  EXPECT_GE(alarms.unacknowledged(), 1);
  EXPECT_TRUE(window_->rect().contains(alarms.geometry()));
  click(alarms.acknowledgeButton());
  EXPECT_TRUE(alarms.unacknowledged() == 0);
}

}  // namespace
}  // namespace helical
