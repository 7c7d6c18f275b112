#include <QDockWidget>
#include <QFile>
#include <QTemporaryDir>

#include "tests/ui/window_fixture.h"

namespace helical {
namespace {

QDockWidget* dock(MainWindow& window, const QString& name) {
  return window.findChild<QDockWidget*>(name);
}

class WindowLayout : public WindowTest {
 protected:
  std::unique_ptr<MainWindow> openWith(const QString& file) {
    WindowOptions options;
    options.layout_file = file;
    auto window = std::make_unique<MainWindow>(rig_, options);
    if (!window->restoreLayout()) window->fitToScreen();
    window->show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(window.get(), kPatienceMs));
    return window;
  }
  RigConfig rig_ = shippedRig(false);
  QTemporaryDir folder_;
};

TEST_F(WindowLayout, PanelsComeBackWhereTheyWereLeft) {
  const QString file = folder_.filePath("layout.ini");
  {
    auto window = openWith(file);
    for (const char* name : {"Cameras", "Plots", "Flight", "Calibration", "Events"})
      ASSERT_NE(dock(*window, name), nullptr) << name;
    window->addDockWidget(Qt::LeftDockWidgetArea, dock(*window, "Events"));
    dock(*window, "Flight")->hide();
    dock(*window, "Calibration")->setFloating(true);
    window->close();
  }
  auto window = openWith(file);
  EXPECT_EQ(window->dockWidgetArea(dock(*window, "Events")), Qt::LeftDockWidgetArea);
  EXPECT_FALSE(dock(*window, "Flight")->isVisible());
  EXPECT_TRUE(dock(*window, "Plots")->isVisible());
  EXPECT_TRUE(dock(*window, "Calibration")->isFloating());
  EXPECT_TRUE(dock(*window, "Calibration")->isVisible());
}

TEST_F(WindowLayout, APanelGetsAWindowOfItsOwnAndComesBackByTheMenu) {
  auto window = openWith({});
  QAction* action = nullptr;
  for (QAction* candidate : window->findChildren<QAction*>())
    if (candidate->text() == "Events" && candidate != dock(*window, "Events")->toggleViewAction())
      action = candidate;
  ASSERT_NE(action, nullptr);
  dock(*window, "Events")->hide();
  action->trigger();
  EXPECT_TRUE(dock(*window, "Events")->isFloating());
  EXPECT_TRUE(dock(*window, "Events")->isVisible());
  action->trigger();
  EXPECT_FALSE(dock(*window, "Events")->isFloating());
  dock(*window, "Events")->setFloating(true);
  EXPECT_TRUE(action->isChecked()) << "as it is, however it came to be";
}

TEST_F(WindowLayout, WithoutAFileOrWithANonsensicalOneItOpensAsEver) {
  const QString file = folder_.filePath("broken.ini");
  QFile broken(file);
  ASSERT_TRUE(broken.open(QIODevice::WriteOnly));
  broken.write("[window]\npanels=nonsense\ngeometry=@ByteArray(xyz)\n");
  broken.close();
  for (const QString& path : {QString(), folder_.filePath("none.ini"), file}) {
    auto window = openWith(path);
    EXPECT_EQ(window->dockWidgetArea(dock(*window, "Events")), Qt::RightDockWidgetArea);
    EXPECT_TRUE(dock(*window, "Flight")->isVisible());
  }
}

}  // namespace
}  // namespace helical
