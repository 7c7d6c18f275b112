#pragma once

#include <QObject>

#include "ui/engine_orders.h"

namespace helical {

class CameraWall;
class ColourEditor;

/// The eyedropper: the colour editor, the preview of its range in every picture, and the clicks that propose
/// one.
class ColourTool : public QObject {
  Q_OBJECT

 public:
  ColourTool(CameraWall& cameras, EngineOrders& orders, QWidget* window);

  ColourEditor& editor() const { return *editor_; }

 public Q_SLOTS:
  void open();

 private:
  void pick(CameraId camera, const Eigen::Vector2d& pixel);
  void preview(const ColourRange& range, bool picking);

  CameraWall& cameras_;
  EngineOrders& orders_;
  ColourEditor* editor_;
};

}  // namespace helical
