#include "ui/colour_tool.h"

#include "ui/camera_pane.h"
#include "ui/camera_wall.h"
#include "ui/colour_editor.h"
#include "ui/picture_scaler.h"

namespace helical {

ColourTool::ColourTool(CameraWall& cameras, EngineOrders& orders, QWidget* window)
    : QObject(window), cameras_(cameras), orders_(orders), editor_(new ColourEditor(window)) {
  connect(&cameras_, &CameraWall::pickRequested, this, &ColourTool::open);
  connect(&cameras_, &CameraWall::colourPicked, this, &ColourTool::pick);
  connect(editor_, &ColourEditor::rangeChanged, this,
          [this](const ColourRange& range) { preview(range, editor_->isVisible()); });
  connect(editor_, &ColourEditor::applyRequested, &orders_, &EngineOrders::setMarkerColour);
  connect(editor_, &ColourEditor::closed, this, [this] {
    if (orders_.engine()) preview(orders_.engine()->markerColour(), false);
  });
}

void ColourTool::open() {
  if (!orders_.engine()) return;
  editor_->show();
  editor_->raise();
  editor_->begin(orders_.engine()->markerColour());
}

void ColourTool::pick(CameraId camera, const Eigen::Vector2d& pixel) {
  if (!orders_.engine()) return;
  ColourRange range = editor_->range();
  if (colourOfBall(orders_.engine()->picture(camera), pixel, range))
    editor_->propose(range);
  else
    editor_->tellNothingPicked();
}

void ColourTool::preview(const ColourRange& range, bool picking) {
  for (int i = 0; i < cameras_.count(); ++i) cameras_.pane(i).previewColour(range, picking);
}

}  // namespace helical
