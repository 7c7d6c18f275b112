#include "ui/figures/figure_layout.h"

#include <algorithm>

#include "ui/figures/figure_text.h"

namespace helical::figures {
namespace {

/// Between a legend's key, or a brace, and its words.
constexpr double kWordGap = 1.0;

double rightMargin(const Figure& figure) {
  double widest = 0.0;
  for (const Panel& panel : figure.panels) {
    for (const RowBrace& brace : panel.braces)
      widest = std::max(widest, kBraceWidth + 2.0 * kWordGap + textWidth(brace.text));
  }
  // Half of the last tick label of the time axis hangs over.
  return std::max(widest + kMargin, kMargin + 0.5 * textWidth(QStringLiteral("25")));
}

/// Places the legend's entries below `top`; returns where the last row ends.
double placeLegend(const Figure& figure, double top, FigureLayout& layout) {
  for (const auto& row : figure.legend) {
    double left = kLeftMargin;
    auto& places = layout.legend.emplace_back();
    for (const LegendEntry& entry : row) {
      const double width = legendEntryWidth(entry);
      if (left > kLeftMargin && left + width > kFigureWidth - kMargin) {
        left = kLeftMargin;
        top += kRowHeight;
      }
      places.emplace_back(left, top + 0.5 * kRowHeight);
      left += width + kLegendGap;
    }
    top += kRowHeight;
  }
  return top;
}

}  // namespace

double legendEntryWidth(const LegendEntry& entry) {
  double key = 0.0;
  if (entry.key == LegendKeyKind::kLine) key = kLegendKeyLength + kWordGap;
  if (entry.key == LegendKeyKind::kBeyondAxis) key = kExitMarkWidth + kWordGap;
  return key + textWidth(entry.text);
}

FigureLayout layoutFigure(const Figure& figure) {
  FigureLayout layout;
  double top = placeLegend(figure, kMargin, layout) + 0.5 * kMargin;
  const double width = kFigureWidth - kLeftMargin - rightMargin(figure);
  for (const Panel& panel : figure.panels) {
    if (!layout.panels.empty()) top += kBetweenPanels;
    const double notes_top = top + kRowHeight * static_cast<double>(panel.spans.size());
    const double frame_top = notes_top + kRowHeight * static_cast<double>(panel.notes.size());
    const QRectF area(kLeftMargin, frame_top, width, panel.height_mm);
    layout.panels.push_back({PlotAxes(area, panel.x, panel.y), top, notes_top});
    top = area.bottom() + kBottomMargin;
  }
  layout.size = QSizeF(kFigureWidth, top + kMargin);
  return layout;
}

}  // namespace helical::figures
