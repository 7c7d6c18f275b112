#include "ui/board_painter.h"

#include <QPainter>

#include "ui/board_editor.h"
#include "ui/theme.h"

namespace helical {

void paintBoard(QPainter& painter, const WhiteBoard& board, bool draft, bool filled,
                const std::function<QPointF(const Eigen::Vector2d&)>& to_screen) {
  QPolygonF outline;
  for (int i = 0; i < board.count; ++i) outline << to_screen(board.corners[static_cast<std::size_t>(i)]);
  painter.setBrush(filled ? QColor(235, 235, 235, draft ? 90 : 170) : QColor(Qt::transparent));
  painter.setPen(QPen(theme::on_dark::kCaution, 1.4, draft ? Qt::DashLine : Qt::SolidLine));
  painter.drawPolygon(outline);
  if (draft) return;
  const QPointF center = to_screen(BoardEditor::handle(board));
  painter.setPen(QPen(QColor(8, 12, 16), 1));
  painter.setBrush(theme::on_dark::kCaution);
  painter.drawEllipse(center, kBoardHandle - 1.0, kBoardHandle - 1.0);
  painter.setPen(QPen(QColor(8, 12, 16), 1.6));
  const double arm = 3.0;
  painter.drawLine(center + QPointF(-arm, -arm), center + QPointF(arm, arm));
  painter.drawLine(center + QPointF(-arm, arm), center + QPointF(arm, -arm));
}

}  // namespace helical
