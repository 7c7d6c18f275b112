#include "ui/preflight_popup.h"

#include <QPainter>
#include <array>

#include "ui/theme.h"

namespace helical {
namespace {

constexpr int kRowHeight = 24;
constexpr int kHeading = 34;
constexpr int kWidth = 420;
constexpr int kDetailLeft = 150;

/// A sign of its own shape for each state: colour alone does not reach everybody.
void paintSign(QPainter& painter, const QPointF& center, Readiness readiness) {
  switch (readiness) {
    case Readiness::kGood:
      painter.setPen(QPen(theme::kHealthy, 2.0, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
      painter.drawPolyline(
          QPolygonF{center + QPointF(-4, 0), center + QPointF(-1, 3.5), center + QPointF(4.5, -3.5)});
      break;
    case Readiness::kCaution:
      painter.setPen(Qt::NoPen);
      painter.setBrush(theme::kCaution);
      painter.drawPolygon(
          QPolygonF{center + QPointF(0, -4.5), center + QPointF(4.8, 3.6), center + QPointF(-4.8, 3.6)});
      break;
    case Readiness::kBad:
      painter.setPen(QPen(theme::kDanger, 2.2, Qt::SolidLine, Qt::RoundCap));
      painter.drawLine(center + QPointF(-3.6, -3.6), center + QPointF(3.6, 3.6));
      painter.drawLine(center + QPointF(-3.6, 3.6), center + QPointF(3.6, -3.6));
      break;
  }
}

}  // namespace

PreflightPopup::PreflightPopup(QWidget* parent) : QFrame(parent, Qt::Popup) {
  setAccessibleName(tr("Pre-flight list"));
}

void PreflightPopup::show(const std::vector<PreflightItem>& items) {
  items_ = items;
  if (isVisible()) resize(sizeHint());
  update();
}

void PreflightPopup::openBelow(const QWidget& anchor) {
  resize(sizeHint());
  const QPoint below = anchor.mapToGlobal(QPoint(anchor.width() / 2 - kWidth / 2, anchor.height() + 6));
  move(below);
  setVisible(true);
}

QSize PreflightPopup::sizeHint() const {
  return {kWidth, kHeading + kRowHeight * static_cast<int>(items_.size()) + 10};
}

void PreflightPopup::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), theme::kTitle);
  painter.setPen(theme::kLine.lighter(130));
  painter.setBrush(Qt::NoBrush);
  painter.drawRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5));
  painter.setFont(theme::capsFont(7.6));
  painter.setPen(theme::kText);
  painter.drawText(QRect(16, 0, width() - 32, kHeading), Qt::AlignVCenter, tr("Pre-flight list"));
  int y = kHeading;
  for (const PreflightItem& item : items_) {
    paintSign(painter, QPointF(24, y + kRowHeight / 2.0), item.readiness);
    painter.setFont(theme::uiFont(8.8, QFont::Medium));
    painter.setPen(theme::kText);
    painter.drawText(QRect(40, y, kDetailLeft - 46, kRowHeight), Qt::AlignVCenter,
                     painter.fontMetrics().elidedText(item.name, Qt::ElideRight, kDetailLeft - 46));
    painter.setFont(theme::uiFont(8.6));
    painter.setPen(item.readiness == Readiness::kGood ? theme::kMuted : theme::kText);
    const int room = width() - kDetailLeft - 12;
    painter.drawText(QRect(kDetailLeft, y, room, kRowHeight), Qt::AlignVCenter,
                     painter.fontMetrics().elidedText(item.detail, Qt::ElideRight, room));
    y += kRowHeight;
  }
}

}  // namespace helical
