#include "ui/figures/figure_drawing.h"

#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <set>

#include "ui/figures/clipped_curve.h"
#include "ui/figures/figure_text.h"

namespace helical::figures {
namespace {

constexpr double kKeyWordGap = 1.0;
constexpr double kTickWordGap = 1.2;
constexpr double kArrowHead = 0.8;

QPen penFor(const Stroke& stroke) {
  QPen pen(stroke.color, stroke.width_mm, stroke.style, Qt::FlatCap, Qt::RoundJoin);
  // Qt's own dashes are too short to be told apart on a line that wavers.
  if (stroke.style == Qt::DashLine) pen.setDashPattern({7.0, 3.0});
  if (stroke.style == Qt::DotLine) pen.setDashPattern({1.5, 1.8});
  return pen;
}

QPen framePen() {
  return QPen(kInk, kFrameWidth, Qt::SolidLine, Qt::SquareCap, Qt::MiterJoin);
}

/// A triangle whose tip stands on the frame.
QPainterPath exitMark(const CurveExit& exit) {
  const double half = 0.5 * kExitMarkWidth;
  QPolygonF mark;
  switch (exit.edge) {
    case PlotEdge::kLeft:
      mark << QPointF(0, 0) << QPointF(kExitMarkWidth, -half) << QPointF(kExitMarkWidth, half);
      break;
    case PlotEdge::kRight:
      mark << QPointF(0, 0) << QPointF(-kExitMarkWidth, -half) << QPointF(-kExitMarkWidth, half);
      break;
    case PlotEdge::kTop:
      mark << QPointF(0, 0) << QPointF(-half, kExitMarkWidth) << QPointF(half, kExitMarkWidth);
      break;
    case PlotEdge::kBottom:
      mark << QPointF(0, 0) << QPointF(-half, -kExitMarkWidth) << QPointF(half, -kExitMarkWidth);
      break;
  }
  QPainterPath path;
  path.addPolygon(mark.translated(exit.at));
  path.closeSubpath();
  return path;
}

/// White around it keeps it apart from its own curve.
void drawExitMark(QPainter& painter, const CurveExit& exit, const QColor& color) {
  const QPainterPath mark = exitMark(exit);
  painter.strokePath(mark, QPen(Qt::white, 2.0 * kFrameWidth));
  painter.fillPath(mark, color);
}

void drawLegendEntry(QPainter& painter, const LegendEntry& entry, const QPointF& place) {
  const double words = place.x() + legendEntryWidth(entry) - textWidth(entry.text);
  if (entry.key == LegendKeyKind::kLine) {
    painter.setPen(penFor(entry.stroke));
    painter.drawLine(place, QPointF(words - kKeyWordGap, place.y()));
  } else if (entry.key == LegendKeyKind::kBeyondAxis) {
    const QPointF tip(0.5 * (place.x() + words - kKeyWordGap), place.y() - 0.5 * kExitMarkWidth);
    drawExitMark(painter, {tip, PlotEdge::kTop}, entry.stroke.color);
  }
  painter.setPen(kInk);
  drawText(painter, {words, place.y()}, Qt::AlignLeft | Qt::AlignVCenter, entry.text);
}

void drawLegend(QPainter& painter, const Figure& figure, const FigureLayout& layout) {
  for (std::size_t row = 0; row < figure.legend.size(); ++row) {
    for (std::size_t i = 0; i < figure.legend[row].size(); ++i)
      drawLegendEntry(painter, figure.legend[row][i], layout.legend[row][i]);
  }
}

/// The shade reaches up to the words, which stand in its middle, or begin with it if it is narrow, within the
/// frame's width.
void drawSpans(QPainter& painter, const Panel& panel, const PanelLayout& layout) {
  const QRectF& area = layout.axes.area();
  double row = layout.spans_top;
  for (const ShadedSpan& span : panel.spans) {
    const double from = std::clamp(layout.axes.xAt(span.from_s), area.left(), area.right());
    const double to = std::clamp(layout.axes.xAt(span.to_s), area.left(), area.right());
    painter.fillRect(QRectF(QPointF(from, row), QPointF(to, area.bottom())), kCoveredShade);
    const double width = textWidth(span.text);
    const double left = std::max(from + 0.5 * kKeyWordGap, 0.5 * (from + to - width));
    painter.setPen(kInk);
    drawText(painter, {std::min(left, area.right() - width), row + 0.5 * kRowHeight},
             Qt::AlignLeft | Qt::AlignVCenter, span.text);
    row += kRowHeight;
  }
}

/// Words beside an arrow that comes down on the frame, and a dotted line on through the plot.
void drawNotes(QPainter& painter, const Panel& panel, const PanelLayout& layout) {
  const QRectF& area = layout.axes.area();
  double row = layout.notes_top;
  for (const TimeNote& note : panel.notes) {
    const double x = std::clamp(layout.axes.xAt(note.at_s), area.left(), area.right());
    painter.setPen(QPen(note.color, kReferenceWidth, Qt::SolidLine, Qt::FlatCap));
    painter.drawLine(QPointF(x, row + 0.4), QPointF(x, area.top() - kArrowHead));
    QPainterPath head;
    head.addPolygon(QPolygonF{QPointF(x, area.top()),
                              QPointF(x - 0.6 * kArrowHead, area.top() - 1.5 * kArrowHead),
                              QPointF(x + 0.6 * kArrowHead, area.top() - 1.5 * kArrowHead)});
    painter.fillPath(head, note.color);
    painter.setPen(penFor({note.color, Qt::DotLine, kFrameWidth}));
    painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()));

    const bool right = x - kKeyWordGap - textWidth(note.text) < kMargin;
    painter.setPen(kInk);
    drawText(painter, {right ? x + kKeyWordGap : x - kKeyWordGap, row + 0.5 * kRowHeight},
             Qt::AlignVCenter | (right ? Qt::AlignLeft : Qt::AlignRight), note.text);
    row += kRowHeight;
  }
}

/// One path for all bars of a raster, however often the selection changes.
void drawRaster(QPainter& painter, const Raster& raster, const PlotAxes& axes) {
  const QRectF& area = axes.area();
  QPainterPath bars;
  std::set<int> beyond;
  for (const LabelRun& run : raster.runs) {
    const QRectF bar(QPointF(axes.xAt(run.from_s), axes.yAt(run.label + 0.5 * kBarHeight)),
                     QPointF(axes.xAt(run.to_s), axes.yAt(run.label - 0.5 * kBarHeight)));
    const QRectF seen = bar & area;
    if (seen.width() > 0.0) bars.addRect(seen);
    if (run.to_s > axes.x().high + axes.x().slack()) beyond.insert(run.label);
  }
  painter.fillPath(bars, raster.color);
  for (const int label : beyond)
    drawExitMark(painter, {QPointF(area.right(), axes.yAt(label)), PlotEdge::kRight}, raster.color);
}

void drawCurves(QPainter& painter, const std::vector<Curve>& curves, const PlotAxes& axes) {
  std::vector<ClippedCurve> clipped;
  for (const Curve& curve : curves) {
    const ClippedCurve& seen = clipped.emplace_back(clipCurve(axes, curve.points));
    painter.setPen(penFor(curve.stroke));
    painter.setBrush(Qt::NoBrush);
    for (const QPolygonF& piece : seen.pieces) painter.drawPolyline(piece);
  }
  for (std::size_t i = 0; i < curves.size(); ++i) {
    for (const CurveExit& exit : clipped[i].exits) drawExitMark(painter, exit, curves[i].stroke.color);
  }
}

void drawTimeAxis(QPainter& painter, const PlotAxes& axes) {
  const QRectF& area = axes.area();
  for (const double tick : axes.x().ticks()) {
    const double x = axes.xAt(tick);
    painter.setPen(framePen());
    painter.drawLine(QPointF(x, area.bottom()), QPointF(x, area.bottom() - kTickLength));
    painter.drawLine(QPointF(x, area.top()), QPointF(x, area.top() + kTickLength));
    drawText(painter, {x, area.bottom() + kTickWordGap}, Qt::AlignHCenter | Qt::AlignTop,
             axes.x().tickText(tick));
  }
  drawText(painter, {area.center().x(), area.bottom() + kBottomMargin - kKeyWordGap},
           Qt::AlignHCenter | Qt::AlignBottom, axes.x().title);
}

void drawValueAxis(QPainter& painter, const PlotAxes& axes) {
  const QRectF& area = axes.area();
  for (const double tick : axes.y().ticks()) {
    const double y = axes.yAt(tick);
    painter.setPen(framePen());
    painter.drawLine(QPointF(area.left(), y), QPointF(area.left() + kTickLength, y));
    painter.drawLine(QPointF(area.right(), y), QPointF(area.right() - kTickLength, y));
    drawText(painter, {area.left() - kTickWordGap, y}, Qt::AlignRight | Qt::AlignVCenter,
             axes.y().tickText(tick));
  }
  drawTextUpwards(painter, {kMargin + 0.5 * kFontSize, area.center().y()}, axes.y().title);
}

void drawBrace(QPainter& painter, const RowBrace& brace, const PlotAxes& axes) {
  const double left = axes.area().right() + kKeyWordGap;
  const double middle = left + 0.5 * kBraceWidth;
  const double right = left + kBraceWidth;
  const double top = axes.yAt(brace.high);
  const double bottom = axes.yAt(brace.low);
  const double center = 0.5 * (top + bottom);
  const double bend = std::min(0.5 * kBraceWidth, 0.25 * (bottom - top));
  QPainterPath path(QPointF(left, top));
  path.quadTo(QPointF(middle, top), QPointF(middle, top + bend));
  path.lineTo(middle, center - bend);
  path.quadTo(QPointF(middle, center), QPointF(right, center));
  path.quadTo(QPointF(middle, center), QPointF(middle, center + bend));
  path.lineTo(middle, bottom - bend);
  path.quadTo(QPointF(middle, bottom), QPointF(left, bottom));
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(kInk, kReferenceWidth));
  painter.drawPath(path);
  drawText(painter, {right + kKeyWordGap, center}, Qt::AlignLeft | Qt::AlignVCenter, brace.text);
}

void drawPanel(QPainter& painter, const Panel& panel, const PanelLayout& layout) {
  drawSpans(painter, panel, layout);
  drawRaster(painter, panel.raster, layout.axes);
  drawCurves(painter, panel.curves, layout.axes);
  drawNotes(painter, panel, layout);
  drawTimeAxis(painter, layout.axes);
  drawValueAxis(painter, layout.axes);
  painter.setPen(framePen());
  painter.setBrush(Qt::NoBrush);
  painter.drawRect(layout.axes.area());
  for (const RowBrace& brace : panel.braces) drawBrace(painter, brace, layout.axes);
}

}  // namespace

void drawFigure(QPainter& painter, const Figure& figure, const FigureLayout& layout) {
  painter.setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing);
  drawLegend(painter, figure, layout);
  for (std::size_t i = 0; i < figure.panels.size(); ++i)
    drawPanel(painter, figure.panels[i], layout.panels[i]);
}

}  // namespace helical::figures
