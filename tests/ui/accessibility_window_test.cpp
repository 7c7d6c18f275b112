#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QAction>
#include <QComboBox>
#include <QDialog>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QPushButton>
#include <QScrollBar>
#include <QTabBar>

#include "tests/ui/window_fixture.h"
#include "ui/calibration_panel.h"
#include "ui/camera_pane.h"
#include "ui/camera_tools.h"
#include "ui/camera_view.h"
#include "ui/camera_wall.h"
#include "ui/colour_editor.h"
#include "ui/colour_tool.h"
#include "ui/event_list.h"
#include "ui/event_panel.h"
#include "ui/key_sheet.h"
#include "ui/scene_view.h"
#include "ui/top_bar.h"

namespace helical {
namespace {

bool isControl(const QWidget& widget) {
  if (qobject_cast<const QScrollBar*>(&widget)) return false;
  return qobject_cast<const QAbstractButton*>(&widget) || qobject_cast<const QComboBox*>(&widget) ||
         qobject_cast<const QAbstractSpinBox*>(&widget) || qobject_cast<const QAbstractSlider*>(&widget) ||
         qobject_cast<const QAbstractItemView*>(&widget) ||
         (qobject_cast<const QLineEdit*>(&widget) && !qobject_cast<const QAbstractSpinBox*>(widget.parent()));
}

/// Qt's own insides, such as the list of a combo box, are not ours to name.
bool ownedByControl(const QWidget& widget) {
  for (const QWidget* above = widget.parentWidget(); above != nullptr; above = above->parentWidget())
    if (qobject_cast<const QComboBox*>(above) || qobject_cast<const QAbstractSpinBox*>(above) ||
        qobject_cast<const QAbstractItemView*>(above) || qobject_cast<const QLineEdit*>(above) ||
        qobject_cast<const QTabBar*>(above) || qobject_cast<const QMenuBar*>(above) ||
        qobject_cast<const QMenu*>(above))
      return true;
  return false;
}

void expectNames(const QWidget& window) {
  int controls = 0;
  for (const QWidget* widget : window.findChildren<QWidget*>()) {
    if (!isControl(*widget) || ownedByControl(*widget) || widget->objectName().startsWith("qt_")) continue;
    ++controls;
    const std::string what = std::string(widget->metaObject()->className()) + " " +
                             widget->objectName().toStdString() + " " +
                             widget->property("text").toString().toStdString();
    EXPECT_FALSE(widget->accessibleName().isEmpty()) << what;
    EXPECT_FALSE(widget->toolTip().isEmpty()) << what;
  }
  EXPECT_GT(controls, 0);
}

void expectTexts(const QList<QAction*>& actions) {
  for (const QAction* action : actions) {
    if (action->isSeparator()) continue;
    EXPECT_FALSE(action->text().isEmpty());
    if (action->menu() != nullptr) expectTexts(action->menu()->actions());
  }
}

using Accessibility = WindowTest;

TEST_F(Accessibility, EveryControlHasANameAndATip) {
  open(false);
  ASSERT_TRUE(eventually([this] { return snapshot().tick > 30; }));
  expectNames(*window_);
  expectNames(window_->colourTool().editor());
}

TEST_F(Accessibility, EveryPanelHasAName) {
  open(false);
  for (const QWidget* panel :
       {static_cast<QWidget*>(&window_->scene()), static_cast<QWidget*>(&window_->events()),
        static_cast<QWidget*>(&window_->cameras().pane(0).view()),
        static_cast<QWidget*>(&window_->calibration()), static_cast<QWidget*>(&window_->cameras())})
    EXPECT_FALSE(panel->accessibleName().isEmpty()) << panel->metaObject()->className();
}

TEST_F(Accessibility, EveryMenuEntryHasAText) {
  open(true);
  expectTexts(window_->topBar().menuBar()->actions());
  expectTexts(window_->cameras().pane(0).tools().actions());
}

TEST_F(Accessibility, TabReachesStopAndEveryPanel) {
  open(false);
  window_->activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(window_.get(), kPatienceMs));
  bool reached_stop = false, reached_camera = false, reached_calibration = false;
  for (int i = 0; i < 200; ++i) {
    press(Qt::Key_Tab);
    const QWidget* focus = QApplication::focusWidget();
    if (focus == nullptr) continue;
    reached_stop |= focus == window_->topBar().stopButton();
    reached_camera |= window_->cameras().isAncestorOf(focus);
    reached_calibration |= window_->calibration().isAncestorOf(focus);
  }
  EXPECT_TRUE(reached_stop);
  EXPECT_TRUE(reached_camera);
}

}  // namespace
}  // namespace helical
