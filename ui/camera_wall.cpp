#include "ui/camera_wall.h"

#include <algorithm>

#include "ui/camera_pane.h"
#include "ui/panel_title.h"

namespace helical {
namespace {

constexpr int kGap = 5;
constexpr int kTitleHeight = 26;

}  // namespace

CameraWall::CameraWall(const RigConfig& rig, QWidget* parent) : QWidget(parent) {
  setAccessibleName(tr("Cameras"));
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    auto* pane = new CameraPane(cameraId(static_cast<int>(i)), rig, this);
    connect(pane, &CameraPane::hideRequested, this, &CameraWall::hideRequested);
    connect(pane, &CameraPane::boardsChanged, this, &CameraWall::boardsChanged);
    connect(pane, &CameraPane::knockRequested, this, &CameraWall::knockRequested);
    connect(pane, &CameraPane::lossRequested, this, &CameraWall::lossRequested);
    connect(pane, &CameraPane::noiseRequested, this, &CameraWall::noiseRequested);
    connect(pane, &CameraPane::pickRequested, this, &CameraWall::pickRequested);
    connect(pane, &CameraPane::colourPicked, this, &CameraWall::colourPicked);
    connect(pane, &CameraPane::firstImagePainted, this, &CameraWall::firstImagePainted);
    panes_.push_back(pane);
  }
}

QSize CameraWall::sizeHint() const {
  return {380, 800};
}
QSize CameraWall::minimumSizeHint() const {
  return {220, 200};
}

int CameraWall::bestColumns() const {
  int best = 1;
  double largest = -1.0;
  for (int columns = 1; columns <= count(); ++columns) {
    const int rows = (count() + columns - 1) / columns;
    const double cell_width = (width() - (columns - 1.0) * kGap) / columns;
    const double cell_height = (height() - (rows - 1.0) * kGap) / rows - kTitleHeight;
    const double picture = std::min(cell_width / 4.0, cell_height / 3.0);
    if (picture > largest) {
      largest = picture;
      best = columns;
    }
  }
  return best;
}

void CameraWall::resizeEvent(QResizeEvent*) {
  if (panes_.empty()) return;
  const int columns = bestColumns();
  const int rows = (count() + columns - 1) / columns;
  for (int i = 0; i < count(); ++i) {
    const int column = i % columns, row = i / columns;
    const int left = column * (width() + kGap) / columns,
              right = (column + 1) * (width() + kGap) / columns - kGap;
    const int top = row * (height() + kGap) / rows, bottom = (row + 1) * (height() + kGap) / rows - kGap;
    pane(i).setGeometry(left, top, right - left, bottom - top);
  }
}

}  // namespace helical
