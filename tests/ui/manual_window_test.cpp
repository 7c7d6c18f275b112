#include <QMenuBar>
#include <QTextBrowser>

#include "tests/ui/window_fixture.h"
#include "ui/manual_window.h"
#include "ui/top_bar.h"

namespace helical {
namespace {

TEST(ManualWindow, SaysWhichFileIsMissing) {
  const ManualWindow manual("/nowhere/manual.md");
  EXPECT_TRUE(manual.text().toPlainText().contains("/nowhere/manual.md"));
}

TEST_F(WindowTest, HelpOpensTheManualBesideTheFlight) {
  open(false);
  ASSERT_TRUE(eventually([this] { return snapshot().tick > 0; }));
  for (QAction* menu : window_->topBar().menuBar()->actions())
    for (QAction* action : menu->menu()->actions())
      if (action->text() == "Manual") action->trigger();
  const auto* manual = window_->findChild<ManualWindow*>();
  ASSERT_NE(manual, nullptr);
  EXPECT_TRUE(manual->isVisible());
  EXPECT_FALSE(manual->isModal());
  EXPECT_TRUE(manual->text().toPlainText().contains("cuts the rotors at once"));
  EXPECT_GT(manual->text().toPlainText().size(), 3000);
  QTest::keyClick(&manual->text(), Qt::Key_Escape);
  EXPECT_TRUE(eventually([this] { return snapshot().safety == SafetyState::kCut; }))
      << "Esc there stops the flight, too";
}

}  // namespace
}  // namespace helical
