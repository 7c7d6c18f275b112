#pragma once

#include <vector>

#include "ui/plot_page.h"

class QCPAxisRect;
class QCPGraph;
class QCustomPlot;

namespace helical {

/// One lane of a sheet as it is drawn.
struct DrawnLane {
  PlotLane description;
  QCPAxisRect* rect = nullptr;
  std::vector<QCPGraph*> graphs;  ///< one per series
  bool blank = false;             ///< nothing to draw in the shown time
};

/// Axes and lines of a lane in `plot`, at its row and column. `lowest`: the time is written below it.
void buildLane(QCustomPlot& plot, DrawnLane& lane, int row, int column, bool lowest);

/// The lines' colours, and those of the axes, in the theme that holds now.
void recolour(DrawnLane& lane);

/// The value axis covers all that its lines have, in whole steps.
void fitRange(DrawnLane& lane);

/// Smaller values are left out on a logarithmic axis.
inline constexpr double kLowestLogarithm = 1e-4;

}  // namespace helical
