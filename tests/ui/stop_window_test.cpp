// STOP and Esc, before dialogs, menus, popups and drags.

#include <QComboBox>
#include <QDialog>
#include <QDockWidget>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QPushButton>
#include <QTimer>

#include "tests/ui/window_fixture.h"
#include "ui/camera_pane.h"
#include "ui/camera_tools.h"
#include "ui/camera_view.h"
#include "ui/camera_wall.h"
#include "ui/colour_editor.h"
#include "ui/colour_tool.h"
#include "ui/key_sheet.h"
#include "ui/preflight_popup.h"
#include "ui/scene_view.h"
#include "ui/top_bar.h"

namespace helical {
namespace {

class Stop : public WindowTest {
 protected:
  void SetUp() override {
    open(false);
    ASSERT_TRUE(eventually([this] { return snapshot().tick > 0; }));
  }
  bool cut() {
    return eventually([this] { return snapshot().safety == SafetyState::kCut; });
  }
  QPoint stopOnScreen() {
    QPushButton* stop = window_->topBar().stopButton();
    return stop->mapToGlobal(stop->rect().center());
  }
  /// A press where STOP is that something else gets, as a popup that holds the mouse does.
  void pressStopThrough(QWidget& grabber) {
    QTest::mousePress(grabber.windowHandle(), Qt::LeftButton, {}, grabber.mapFromGlobal(stopOnScreen()));
  }
};

TEST_F(Stop, EscInAModalDialog) {
  QDialog dialog(window_.get());
  QTimer::singleShot(0, &dialog, [&dialog] { QTest::keyClick(&dialog, Qt::Key_Escape); });
  dialog.exec();
  EXPECT_TRUE(cut());
  EXPECT_TRUE(eventually([this] { return window_->topBar().readiness() == "Cut"; }));
  EXPECT_TRUE(snapshot().failsafes & static_cast<std::uint32_t>(Failsafe::kKill));
}

TEST_F(Stop, EscInATextField) {
  QDialog dialog(window_.get());
  QLineEdit field(&dialog);
  dialog.show();
  field.setFocus();
  QTest::keyClick(&field, Qt::Key_Escape);
  EXPECT_TRUE(cut());
}

TEST_F(Stop, EscInAnOpenMenu) {
  QMenu* menu = window_->topBar().menuBar()->actions().first()->menu();
  menu->popup(window_->mapToGlobal(QPoint(200, 60)));
  ASSERT_TRUE(eventually([menu] { return menu->isVisible(); }));
  QTest::keyClick(menu, Qt::Key_Escape);
  EXPECT_TRUE(cut());
}

TEST_F(Stop, EscInAnOpenList) {
  auto* list = window_->findChild<QComboBox*>();
  ASSERT_NE(list, nullptr);
  list->setEnabled(true);
  list->showPopup();
  QWidget* popup = nullptr;
  ASSERT_TRUE(eventually([&] { return (popup = QApplication::activePopupWidget()) != nullptr; }));
  QTest::keyClick(popup, Qt::Key_Escape);
  EXPECT_TRUE(cut());
}

TEST_F(Stop, EscWhileABoardIsDrawn) {
  CameraView& view = window_->cameras().pane(0).view();
  view.setBoardTool(BoardEditor::Tool::kRectangle);
  QTest::mousePress(&view, Qt::LeftButton, {}, view.rect().center());
  QTest::mouseMove(&view, view.rect().center() + QPoint(30, 20));
  press(Qt::Key_Escape);
  EXPECT_TRUE(cut());
}

TEST_F(Stop, EscWhileAPanelIsDragged) {
  auto* dock = window_->findChild<QDockWidget*>("Events");
  QWidget* title = dock->titleBarWidget();
  const QPoint at(20, 10);
  QTest::mousePress(title, Qt::LeftButton, {}, at);
  for (int i = 1; i < 6; ++i) QTest::mouseMove(title, at - QPoint(30 * i, 20 * i));
  press(Qt::Key_Escape);
  EXPECT_TRUE(cut());
  QTest::mouseRelease(title, Qt::LeftButton, {}, at);
}

TEST_F(Stop, TheButtonActsWhenItGoesDown) {
  QTest::mousePress(window_->topBar().stopButton(), Qt::LeftButton);
  EXPECT_TRUE(cut());
  EXPECT_TRUE(eventually([this] { return !window_->topBar().landButton()->isEnabled(); }));
}

TEST_F(Stop, TheButtonUnderAnOpenMenu) {
  CameraTools& menu = window_->cameras().pane(0).tools();
  menu.popup(window_->mapToGlobal(QPoint(300, 300)));
  ASSERT_TRUE(eventually([&] { return menu.isVisible(); }));
  pressStopThrough(menu);
  EXPECT_TRUE(cut());
}

TEST_F(Stop, TheButtonUnderThePreFlightList) {
  click(window_->topBar().readinessButton());
  PreflightPopup& list = window_->topBar().preflight();
  ASSERT_TRUE(eventually([&] { return list.isVisible(); }));
  pressStopThrough(list);
  EXPECT_TRUE(cut());
}

TEST_F(Stop, APressBesideTheButtonStopsNothing) {
  click(window_->topBar().readinessButton());
  PreflightPopup& list = window_->topBar().preflight();
  ASSERT_TRUE(eventually([&] { return list.isVisible(); }));
  QTest::mousePress(list.windowHandle(), Qt::LeftButton, {},
                    list.mapFromGlobal(stopOnScreen() - QPoint(0, 300)));
  const std::uint64_t tick = snapshot().tick;
  ASSERT_TRUE(eventually([&] { return snapshot().tick > tick + 20; }));
  EXPECT_EQ(snapshot().safety, SafetyState::kNormal);
}

TEST_F(Stop, NoneOfTheWindowsOwnDialogsBlocksIt) {
  for (QAction* menu : window_->topBar().menuBar()->actions())
    for (QAction* action : menu->menu()->actions())
      if (action->text().startsWith("About") || action->text().startsWith("Keys") || action->text() == "Manual")
        action->trigger();
  window_->colourTool().editor().show();
  const auto dialogs = window_->findChildren<QDialog*>();
  EXPECT_GE(dialogs.size(), 4);
  for (const QDialog* dialog : dialogs)
    EXPECT_FALSE(dialog->isModal()) << dialog->windowTitle().toStdString();
  EXPECT_EQ(QApplication::activeModalWidget(), nullptr);
  QTest::mousePress(window_->topBar().stopButton(), Qt::LeftButton);
  EXPECT_TRUE(cut());
}

}  // namespace
}  // namespace helical
