#pragma once

#include <QRectF>
#include <QSizeF>
#include <vector>

#include "engine/config/rig_config.h"
#include "ui/scene_frame.h"

class QPainter;

namespace helical {

/// Boxes of `sizes` centred at `anchors`, moved up or down by whole lines where one would cover another that
/// comes before it in the list: the same anchors give the same boxes, and who comes first stays where it is.
/// What finds no place within a few lines stays at its anchor.
std::vector<QRectF> placeLabels(const std::vector<QPointF>& anchors, const std::vector<QSizeF>& sizes);

/// The cameras' names over a picture of the scene, each in its camera's colour, with a thin line to what it
/// names where it had to make room.
void paintSceneLabels(QPainter& painter, const std::vector<SceneLabel>& labels, const RigConfig& rig);

}  // namespace helical
