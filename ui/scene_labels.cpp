#include "ui/scene_labels.h"

#include <QFontMetricsF>
#include <QPainter>
#include <QString>
#include <algorithm>

#include "ui/theme.h"

namespace helical {
namespace {

constexpr int kMostLines = 6;
constexpr int kFaintAlpha = 110;  // of a camera that is not in use
constexpr QSizeF kPadding(6.0, 2.0);
const QColor kShade(12, 16, 21, 140);  // legible over frusta, too

/// 0, 1 up, 1 down, 2 up, ...
double shiftOf(int attempt, double line) {
  const int lines = (attempt + 1) / 2;
  return attempt % 2 == 1 ? -lines * line : lines * line;
}

}  // namespace

std::vector<QRectF> placeLabels(const std::vector<QPointF>& anchors, const std::vector<QSizeF>& sizes) {
  std::vector<QRectF> placed;
  for (std::size_t i = 0; i < anchors.size(); ++i) {
    const QRectF at(anchors[i] - QPointF(0.5 * sizes[i].width(), 0.5 * sizes[i].height()), sizes[i]);
    QRectF box = at;
    const auto covers = [&](const QRectF& other) { return box.intersects(other); };
    int attempt = 0;
    while (attempt <= 2 * kMostLines && std::any_of(placed.begin(), placed.end(), covers))
      box = at.translated(0.0, shiftOf(++attempt, sizes[i].height()));
    placed.push_back(attempt > 2 * kMostLines ? at : box);
  }
  return placed;
}

void paintSceneLabels(QPainter& painter, const std::vector<SceneLabel>& labels, const RigConfig& rig) {
  painter.setFont(theme::capsFont(7.6));
  const QFontMetricsF metrics(painter.font());
  std::vector<QPointF> anchors;
  std::vector<QSizeF> sizes;
  std::vector<QString> names;
  for (const SceneLabel& label : labels) {
    names.push_back(QString::fromStdString(rig.cameras[static_cast<std::size_t>(label.camera)].name));
    anchors.push_back(label.position);
    sizes.push_back(QSizeF(metrics.horizontalAdvance(names.back()), metrics.height()) + kPadding);
  }
  const std::vector<QRectF> boxes = placeLabels(anchors, sizes);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    QColor color = theme::on_dark::cameraColor(labels[i].camera);
    if (!labels[i].in_use) color.setAlpha(kFaintAlpha);
    painter.fillRect(boxes[i], kShade);
    painter.setPen(color);
    painter.drawText(boxes[i], Qt::AlignCenter, names[i]);
    if (boxes[i].contains(anchors[i])) continue;
    color.setAlpha(kFaintAlpha);
    painter.setPen(QPen(color, 0.8));
    const double edge = boxes[i].center().y() < anchors[i].y() ? boxes[i].bottom() : boxes[i].top();
    painter.drawLine(QPointF(anchors[i].x(), edge), anchors[i]);
  }
}

}  // namespace helical
