#include "ui/heat_maps.h"

#include <QContextMenuEvent>
#include <QPainter>
#include <QTextStream>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "ui/format.h"
#include "ui/plot_saving.h"
#include "ui/theme.h"

namespace helical {
namespace {

constexpr int kCaption = 17;
constexpr int kGap = 10;
constexpr double kTellingResidual = 0.5;  // px: smaller ones never look hot

/// From night blue over teal to pale yellow, 0 to 1: told apart without red and green.
QColor heatColor(double value) {
  static const std::array<QColor, 4> stops{QColor(0x16, 0x2a, 0x44), QColor(0x1d, 0x6f, 0x8c),
                                           QColor(0x4c, 0xb8, 0xa0), QColor(0xf4, 0xe9, 0x9b)};
  const double at = std::clamp(value, 0.0, 1.0) * (stops.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  const double f = at - static_cast<double>(low);
  const auto blend = [&](int a, int b) { return static_cast<int>(std::lround(a + f * (b - a))); };
  const QColor &a = stops[low], &b = stops[low + 1];
  return {blend(a.red(), b.red()), blend(a.green(), b.green()), blend(a.blue(), b.blue())};
}

void paintMap(QPainter& painter, const QRectF& area, const std::function<double(int, int)>& value) {
  painter.fillRect(area, theme::kGrid);
  const double width = area.width() / ImageHeat::kColumns, height = area.height() / ImageHeat::kRows;
  for (int row = 0; row < ImageHeat::kRows; ++row)
    for (int column = 0; column < ImageHeat::kColumns; ++column) {
      const double heat = value(column, row);
      if (!std::isfinite(heat)) continue;
      painter.fillRect(
          QRectF(area.left() + column * width, area.top() + row * height, width - 0.6, height - 0.6),
          heatColor(heat));
    }
}

}  // namespace

HeatMaps::HeatMaps(const QString& camera_name, QSize sensor, QWidget* parent)
    : QWidget(parent), camera_name_(camera_name), heat_(sensor) {
  setAccessibleName(tr("Coverage and residual maps of %1").arg(camera_name));
  setToolTip(
      tr("Left: where in the image used markers were seen, right: how far off they were there. Right click: "
         "save"));
}

void HeatMaps::clear() {
  heat_.clear();
  update();
}

void HeatMaps::contextMenuEvent(QContextMenuEvent* event) {
  QString name = camera_name_;
  name.replace(QLatin1Char(' '), QLatin1Char('-'));
  offerToSave(this, event->globalPos(), QStringLiteral("coverage-%1").arg(name),
              [this](const QString& path) { return save(path); });
}

bool HeatMaps::save(const QString& path) {
  return savePlot(*this, path, [this] { return table(); });
}

QString HeatMaps::table() const {
  QString text = QStringLiteral("u_px,v_px,markers,residual_px\n");
  QTextStream out(&text, QIODevice::Append);
  for (int row = 0; row < ImageHeat::kRows; ++row)
    for (int column = 0; column < ImageHeat::kColumns; ++column) {
      const QPointF middle = heat_.middle(column, row);
      out << middle.x() << ',' << middle.y() << ',' << heat_.count(column, row) << ',';
      if (const double residual = heat_.residual(column, row); std::isfinite(residual)) out << residual;
      out << '\n';
    }
  out.flush();
  return text;
}

void HeatMaps::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const double width = 0.5 * (this->width() - kGap),
               height = std::min(this->height() - kCaption * 1.0, 0.75 * width);
  const double map_width = height / 0.75;
  const QRectF left(0.0, kCaption, map_width, height), right(width + kGap, kCaption, map_width, height);
  const double most = std::max(1, heat_.largestCount());
  paintMap(painter, left, [&](int column, int row) {
    const int count = heat_.count(column, row);
    return count > 0 ? std::log1p(count) / std::log1p(most) : std::nan("");
  });
  const double worst = std::max(kTellingResidual, heat_.largestResidual());
  paintMap(painter, right, [&](int column, int row) { return heat_.residual(column, row) / worst; });
  painter.setFont(theme::uiFont(7.6));
  painter.setPen(theme::kMuted);
  painter.drawText(QRectF(left.left(), 0, map_width, kCaption), Qt::AlignVCenter,
                   tr("seen in %1 %").arg(plainNumber(100.0 * heat_.covered(), 0)));
  const double largest = heat_.largestResidual();
  painter.drawText(QRectF(right.left(), 0, map_width, kCaption), Qt::AlignVCenter,
                   largest > 0.0 ? tr("error up to %1 px").arg(plainNumber(largest, 2)) : tr("error"));
}

}  // namespace helical
