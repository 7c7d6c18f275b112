#include "ui/figures/clipped_curve.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "ui/figures/figure_style.h"

namespace helical::figures {
namespace {

/// The visible part of a segment, as shares of its length, and the edge through which it leaves.
struct VisiblePart {
  double from = 0.0;
  double to = 1.0;
  PlotEdge leaves = PlotEdge::kTop;  ///< valid if `to` is below 1
};

/// All in data, where the ends of the axes are exact.
std::optional<VisiblePart> visiblePart(const PlotAxes& axes, const QPointF& start, const QPointF& end) {
  struct Bound {
    PlotEdge edge;
    double outward;  ///< how far the segment goes towards this edge
    double room;     ///< how far its start is from it
  };
  const QPointF along = end - start;
  const Bound bounds[] = {{PlotEdge::kLeft, -along.x(), start.x() - axes.x().low},
                          {PlotEdge::kRight, along.x(), axes.x().high - start.x()},
                          {PlotEdge::kTop, along.y(), axes.y().high - start.y()},
                          {PlotEdge::kBottom, -along.y(), start.y() - axes.y().low}};
  VisiblePart part;
  for (const Bound& bound : bounds) {
    if (bound.outward == 0.0) {
      if (bound.room < 0.0) return std::nullopt;
      continue;
    }
    const double crossing = bound.room / bound.outward;
    if (bound.outward < 0.0) {
      part.from = std::max(part.from, crossing);
    } else if (crossing < part.to) {
      part.to = crossing;
      part.leaves = bound.edge;
    }
  }
  if (part.from > part.to) return std::nullopt;
  return part;
}

/// The edge beyond which a point lies.
PlotEdge edgeTowards(const PlotAxes& axes, const QPointF& outside) {
  if (outside.y() > axes.y().high) return PlotEdge::kTop;
  if (outside.y() < axes.y().low) return PlotEdge::kBottom;
  return outside.x() < axes.x().low ? PlotEdge::kLeft : PlotEdge::kRight;
}

/// Follows a curve from point to point.
class CurveClipper {
 public:
  explicit CurveClipper(const PlotAxes& axes) : axes_(axes) {}

  void add(const QPointF& point) {
    if (last_)
      addSegment(*last_, point);
    else
      start(point);
    last_ = point;
  }
  void interrupt() { last_.reset(); }
  ClippedCurve take() { return std::move(curve_); }

 private:
  void start(const QPointF& point) {
    if (axes_.contains(point))
      curve_.pieces.push_back(QPolygonF{axes_.at(point)});
    else
      addExit(point, edgeTowards(axes_, point));
  }

  void addSegment(const QPointF& start, const QPointF& end) {
    const auto part = visiblePart(axes_, start, end);
    if (!part) return;
    const QPointF along = end - start;
    if (!axes_.contains(start)) curve_.pieces.push_back(QPolygonF{axes_.at(start + part->from * along)});
    const QPointF seen = start + part->to * along;
    curve_.pieces.back().append(axes_.at(seen));
    if (part->to < 1.0) addExit(seen, part->leaves);
  }

  void addExit(const QPointF& point, PlotEdge edge) {
    const QPointF at = axes_.at({std::clamp(point.x(), axes_.x().low, axes_.x().high),
                                 std::clamp(point.y(), axes_.y().low, axes_.y().high)});
    for (auto known = curve_.exits.rbegin(); known != curve_.exits.rend(); ++known) {
      const QPointF apart = known->at - at;
      if (known->edge == edge && std::hypot(apart.x(), apart.y()) < kExitMarkWidth) return;
    }
    curve_.exits.push_back({at, edge});
  }

  const PlotAxes& axes_;
  std::optional<QPointF> last_;
  ClippedCurve curve_;
};

/// What is hardly beyond an axis is on its end; an infinite value is made finite, but stays beyond.
double snapped(double value, const PlotAxis& axis) {
  const double nearest = std::clamp(value, axis.low, axis.high);
  const double span = axis.high - axis.low;
  return std::abs(value - nearest) < axis.slack()
             ? nearest
             : std::clamp(value, axis.low - 1e6 * span, axis.high + 1e6 * span);
}

}  // namespace

ClippedCurve clipCurve(const PlotAxes& axes, const std::vector<QPointF>& points) {
  CurveClipper clipper(axes);
  for (const QPointF& point : points) {
    if (std::isnan(point.x()) || std::isnan(point.y())) {
      clipper.interrupt();
      continue;
    }
    clipper.add({snapped(point.x(), axes.x()), snapped(point.y(), axes.y())});
  }
  return clipper.take();
}

}  // namespace helical::figures
