#pragma once

#include <QPointF>
#include <functional>

#include "engine/pipeline/white_board.h"

class QPainter;

namespace helical {

/// Radius of the cross that removes a board, in screen pixels.
inline constexpr double kBoardHandle = 8.0;

/// Draws the outline of a white board before a camera with its cross, or dashed and without while it is being
/// drawn. `filled`: nothing else shows that it is white. `to_screen` places pixels of the image.
void paintBoard(QPainter& painter, const WhiteBoard& board, bool draft, bool filled,
                const std::function<QPointF(const Eigen::Vector2d&)>& to_screen);

}  // namespace helical
