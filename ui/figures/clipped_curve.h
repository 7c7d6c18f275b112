#pragma once

#include <QPointF>
#include <QPolygonF>
#include <vector>

#include "ui/figures/plot_axes.h"

namespace helical::figures {

/// An edge of a plot's frame.
enum class PlotEdge { kLeft, kRight, kTop, kBottom };

/// Where a curve leaves its plot.
struct CurveExit {
  QPointF at;  ///< on the frame [mm]
  PlotEdge edge = PlotEdge::kTop;
};

/// What is to be seen of a curve: its pieces inside the frame, and where it goes on outside.
struct ClippedCurve {
  std::vector<QPolygonF> pieces;  ///< mm
  std::vector<CurveExit> exits;   ///< one for those closer together than a marker is wide
};

/// Cuts a curve of data points at the frame (Liang and Barsky, 1984); see `PlotAxis::slack`. A point that is
/// not a number breaks the curve; an infinite one is beyond the axis.
ClippedCurve clipCurve(const PlotAxes& axes, const std::vector<QPointF>& points);

}  // namespace helical::figures
