// The window on a display where everything is twice as large.

#include <QAbstractButton>
#include <QDir>
#include <QLabel>
#include <QScreen>

#include "tests/ui/window_fixture.h"
#include "ui/scene_view.h"

namespace helical {
namespace {

using ScaledWindow = WindowTest;

TEST_F(ScaledWindow, FitsOnTheScreenWithAllItsWords) {
  open(true);
  ASSERT_EQ(window_->devicePixelRatioF(), 2.0);
  ASSERT_TRUE(eventually([this] { return snapshot().pose_known; }));
  ASSERT_NO_FATAL_FAILURE(takeOffByMouse());
  const int frames = window_->scene().renderedFrames();
  ASSERT_TRUE(eventually([&] { return window_->scene().renderedFrames() >= frames + 3; }));
  EXPECT_TRUE(window_->screen()->geometry().contains(window_->geometry()));
  for (const QAbstractButton* button : window_->findChildren<QAbstractButton*>()) {
    if (!button->isVisible() || button->text().isEmpty()) continue;
    const int needed = QFontMetrics(button->font()).horizontalAdvance(button->text().remove('&'));
    EXPECT_GE(button->width(), needed) << button->text().toStdString();
  }
  const QImage picture = window_->grab().toImage();
  EXPECT_EQ(picture.width(), 2 * window_->width()) << "drawn in the display's pixels, not blown up";
  const QString folder = QStringLiteral(HELICAL_PICTURE_DIR);
  ASSERT_TRUE(QDir().mkpath(folder));
  ASSERT_TRUE(picture.save(folder + "/scale_200.png"));
}

}  // namespace
}  // namespace helical
