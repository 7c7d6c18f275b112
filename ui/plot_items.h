#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ui/plot_axes.h"
#include "ui/plot_spans.h"
#include "ui/time_axis.h"

namespace helical {

/// What the lanes of a sheet say beside their lines.
struct PlotReadout {
  const TickHistory& history;
  const TimeAxis& axis;
  std::vector<PlotSpan> spans;    ///< in the shown time
  std::optional<double> hovered;  ///< the pointer's time [s]

  /// The row whose values the headings show: the pointer's, else the newest.
  std::optional<std::int64_t> row() const;
};

/// Adds to a lane what is drawn behind its lines (spans, the pointer's time) and over them (title, legend with
/// values, `names_spans`: the spans' names; a note where there is nothing to draw). `readout` and `lane` must
/// outlive `plot`.
void addItems(QCustomPlot& plot, const PlotReadout& readout, const DrawnLane& lane, bool names_spans);

}  // namespace helical
