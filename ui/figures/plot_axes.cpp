#include "ui/figures/plot_axes.h"

#include <cmath>

#include "engine/base/check.h"

namespace helical::figures {

std::vector<double> PlotAxis::ticks() const {
  std::vector<double> ticks;
  const int last = static_cast<int>(std::floor((high - first_tick) / step + 1e-9));
  for (int i = 0; i <= last; ++i) ticks.push_back(first_tick + i * step);
  return ticks;
}

QString PlotAxis::tickText(double tick) const {
  if (std::abs(tick) < 0.5 * step) return QStringLiteral("0");
  const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
  return QString::number(tick, 'f', decimals).replace(QChar('-'), QChar(0x2212));
}

PlotAxis plotAxis(const QString& title, double low, double high, double step) {
  return PlotAxis{title, low, high, step, low};
}

PlotAxes::PlotAxes(const QRectF& area, const PlotAxis& x, const PlotAxis& y) : area_(area), x_(x), y_(y) {
  HELICAL_CHECK(x.low < x.high && y.low < y.high && x.step > 0.0 && y.step > 0.0);
}

QPointF PlotAxes::at(const QPointF& data) const {
  return {xAt(data.x()), yAt(data.y())};
}

double PlotAxes::xAt(double data) const {
  return area_.left() + area_.width() * (data - x_.low) / (x_.high - x_.low);
}

double PlotAxes::yAt(double data) const {
  return area_.bottom() - area_.height() * (data - y_.low) / (y_.high - y_.low);
}

bool PlotAxes::contains(const QPointF& data) const {
  return data.x() >= x_.low && data.x() <= x_.high && data.y() >= y_.low && data.y() <= y_.high;
}

}  // namespace helical::figures
