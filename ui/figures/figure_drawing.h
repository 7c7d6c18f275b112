#pragma once

#include "ui/figures/figure.h"
#include "ui/figures/figure_layout.h"

class QPainter;

namespace helical::figures {

/// Draws a figure with a painter whose unit is 1 mm and whose origin is the page's top left corner, on white
/// paper. What lies beyond an axis is cut off at the frame, and a small triangle in the curve's colour, or
/// the raster's, points to where it went. Needs a QGuiApplication; any thread, one at a time.
void drawFigure(QPainter& painter, const Figure& figure, const FigureLayout& layout);

}  // namespace helical::figures
