#pragma once

#include <QColor>
#include <QPointF>
#include <QString>
#include <vector>

#include "ui/figures/figure_style.h"
#include "ui/figures/label_runs.h"
#include "ui/figures/plot_axes.h"

namespace helical::figures {

/// What a figure shows, before anything is placed or drawn: values in the units of its axes.

struct Stroke {
  QColor color = kInk;
  Qt::PenStyle style = Qt::SolidLine;
  double width_mm = kCurveWidth;
};

struct Curve {
  Stroke stroke;
  std::vector<QPointF> points;  ///< one that is not a number breaks the curve
};

/// The bars of a raster: rows are labels.
struct Raster {
  QColor color = kInk;
  std::vector<LabelRun> runs;
};

/// A stretch of time that is shaded, with the words why.
struct ShadedSpan {
  QString text;
  double from_s = 0.0;
  double to_s = 0.0;
};

/// A moment that an arrow points at.
struct TimeNote {
  QString text;
  QColor color = kInk;
  double at_s = 0.0;
};

/// A brace at the right that names the rows from `low` to `high`.
struct RowBrace {
  QString text;
  double low = 0.0;
  double high = 0.0;
};

struct Panel {
  PlotAxis x;
  PlotAxis y;
  double height_mm = kCurvesHeight;
  std::vector<Curve> curves;
  Raster raster;
  std::vector<ShadedSpan> spans;
  std::vector<TimeNote> notes;  ///< the latest first, so that no arrow crosses the words of another
  std::vector<RowBrace> braces;
};

enum class LegendKeyKind { kNone, kLine, kBeyondAxis };

struct LegendEntry {
  QString text;
  LegendKeyKind key = LegendKeyKind::kLine;
  Stroke stroke;
};

struct Figure {
  QString file_stem;  ///< "fig06"
  QString title;
  std::vector<std::vector<LegendEntry>> legend;  ///< rows; one that is too wide is wrapped
  std::vector<Panel> panels;                     ///< from the top down
};

}  // namespace helical::figures
