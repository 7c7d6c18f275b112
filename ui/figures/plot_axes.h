#pragma once

#include <QPointF>
#include <QRectF>
#include <QString>
#include <vector>

namespace helical::figures {

/// One axis of a plot, in the data's unit. Ticks stand at the multiples of `step` from `first_tick` to
/// `high`; `low` may lie a little below the first of them, to leave room for a row at zero.
struct PlotAxis {
  QString title;
  double low = 0.0;
  double high = 1.0;
  double step = 1.0;
  double first_tick = 0.0;

  std::vector<double> ticks() const;
  /// What lies beyond an end by less than this, about a line's width on paper, counts as on it.
  double slack() const { return 0.005 * (high - low); }
  /// With as many decimals as the step has, and a true minus sign; "0" for zero.
  QString tickText(double tick) const;
};

/// An axis whose first tick is its low end.
PlotAxis plotAxis(const QString& title, double low, double high, double step);

/// Where data lie on the page: x to the right and y up in the data's units, page in mm with y down. A value.
class PlotAxes {
 public:
  PlotAxes(const QRectF& area, const PlotAxis& x, const PlotAxis& y);

  const QRectF& area() const { return area_; }  ///< inside of the frame [mm]
  const PlotAxis& x() const { return x_; }
  const PlotAxis& y() const { return y_; }

  QPointF at(const QPointF& data) const;  ///< on the page [mm], also beyond the frame
  double xAt(double data) const;
  double yAt(double data) const;
  bool contains(const QPointF& data) const;

 private:
  QRectF area_;
  PlotAxis x_;
  PlotAxis y_;
};

}  // namespace helical::figures
