#include "ui/event_panel.h"

#include <gtest/gtest.h>

#include <QLineEdit>
#include <QToolButton>
#include <cstdio>

#include "ui/alarm_bar.h"
#include "ui/event_list.h"

namespace helical {
namespace {

EngineEvent event(double time_s, Severity severity, const char* text) {
  EngineEvent result;
  result.time = fromSeconds(time_s);
  result.severity = severity;
  std::snprintf(result.text.data(), result.text.size(), "%s", text);
  return result;
}

class EventPanelTest : public testing::Test {
 protected:
  EventPanelTest() {
    panel_.add(event(1.0, Severity::kGood, "Helicopter found"));
    panel_.add(event(2.0, Severity::kInfo, "Rotors start"));
    panel_.add(event(3.0, Severity::kCaution, "Camera 2: hidden by the operator"));
    panel_.add(event(4.0, Severity::kDanger, "No pose for 0.5 s: open-loop descent"));
  }
  EventPanel panel_;
};

TEST_F(EventPanelTest, FiltersBySeverity) {
  EXPECT_EQ(panel_.list().shownCount(), 4);
  panel_.severityButton(Severity::kInfo)->click();
  panel_.severityButton(Severity::kGood)->click();
  EXPECT_EQ(panel_.list().shownCount(), 2);
  panel_.add(event(5.0, Severity::kInfo, "Landing"));
  EXPECT_EQ(panel_.list().shownCount(), 2) << "new ones, too";
  panel_.severityButton(Severity::kInfo)->click();
  EXPECT_EQ(panel_.list().shownCount(), 4);
}

TEST_F(EventPanelTest, FiltersByWordsInAnyOrderAndCase) {
  panel_.words()->setText("operator camera");
  EXPECT_EQ(panel_.list().shownCount(), 1);
  panel_.words()->setText("NO POSE");
  EXPECT_EQ(panel_.list().shownCount(), 1);
  panel_.words()->setText("nothing of this");
  EXPECT_EQ(panel_.list().shownCount(), 0);
  panel_.words()->clear();
  EXPECT_EQ(panel_.list().shownCount(), 4);
}

TEST_F(EventPanelTest, ADangerIsOpenUntilAcknowledged) {
  EXPECT_EQ(panel_.list().unacknowledgedCount(), 1);
  panel_.list().acknowledge();
  EXPECT_EQ(panel_.list().unacknowledgedCount(), 0);
  panel_.add(event(9.0, Severity::kDanger, "Rotors cut, latched"));
  EXPECT_EQ(panel_.list().unacknowledgedCount(), 1);
}

TEST_F(EventPanelTest, AcknowledgingTheAlarmSaysSo) {
  QWidget window;
  AlarmBar bar(&window);
  QObject::connect(&bar, &AlarmBar::acknowledged, [this] { panel_.list().acknowledge(); });
  bar.add(event(4.0, Severity::kDanger, "No pose for 0.5 s: open-loop descent"));
  bar.acknowledge();
  EXPECT_EQ(panel_.list().unacknowledgedCount(), 0);
}

}  // namespace
}  // namespace helical
