#pragma once

#include <QSizeF>
#include <vector>

#include "ui/figures/figure.h"
#include "ui/figures/plot_axes.h"

namespace helical::figures {

/// Where a panel's parts lie on the page [mm].
struct PanelLayout {
  PlotAxes axes;
  double spans_top = 0.0;  ///< a row for the words of each shaded span, then
  double notes_top = 0.0;  ///< one for each note, then the frame
};

/// Where a figure's parts lie on the page [mm]. The legend, the words of shaded spans and the notes have rows
/// of their own above the frames: nothing covers data.
struct FigureLayout {
  QSizeF size;
  std::vector<std::vector<QPointF>> legend;  ///< left end of each entry, half way up its row
  std::vector<PanelLayout> panels;
};

/// Room that a legend entry takes [mm], without the gap to the next.
double legendEntryWidth(const LegendEntry& entry);

/// Needs a QGuiApplication, for the widths of words.
FigureLayout layoutFigure(const Figure& figure);

}  // namespace helical::figures
