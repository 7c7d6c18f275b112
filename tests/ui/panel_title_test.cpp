#include "ui/panel_title.h"

#include <gtest/gtest.h>

#include <QToolButton>

#include "ui/theme.h"

namespace helical {
namespace {

int brightPixels(const QImage& image) {
  int count = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) count += image.pixelColor(x, y).lightness() > 150;
  return count;
}

TEST(PanelTitle, AHiddenButtonTakesNoRoomFromTheName) {
  PanelTitle title("Camera 1", theme::kActive);
  auto* hidden = new QToolButton;
  title.addWidget(hidden);
  title.resize(180, title.sizeHint().height());
  hidden->hide();
  PanelTitle nameless("", theme::kActive);
  nameless.resize(title.size());
  EXPECT_GT(brightPixels(title.grab().toImage()), brightPixels(nameless.grab().toImage()) + 20);
}

}  // namespace
}  // namespace helical
