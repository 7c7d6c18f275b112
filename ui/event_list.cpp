#include "ui/event_list.h"

#include <QPainter>
#include <QScrollBar>
#include <QStyledItemDelegate>
#include <algorithm>

#include "ui/format.h"
#include "ui/theme.h"

namespace helical {
namespace {

constexpr int kLongestList = 1000;
constexpr int kScrollBar = 10;
constexpr int kTextLeft = 82;
constexpr int kSeverityRole = Qt::UserRole;
constexpr int kTimeRole = Qt::UserRole + 1;

/// Disc, disc, triangle, square: told apart without colour.
void paintSign(QPainter& painter, const QPointF& center, Severity severity) {
  painter.setPen(Qt::NoPen);
  switch (severity) {
    case Severity::kInfo:
      painter.setPen(QPen(theme::kActive, 1.4));
      painter.setBrush(Qt::NoBrush);
      painter.drawEllipse(center, 2.8, 2.8);
      break;
    case Severity::kGood:
      painter.setBrush(theme::kHealthy);
      painter.drawEllipse(center, 3.4, 3.4);
      break;
    case Severity::kCaution:
      painter.setBrush(theme::kCaution);
      painter.drawPolygon(
          QPolygonF{center + QPointF(0, -4.5), center + QPointF(4.6, 3.4), center + QPointF(-4.6, 3.4)});
      break;
    case Severity::kDanger:
      painter.setBrush(theme::kDanger);
      painter.drawRect(QRectF(center - QPointF(3.8, 3.8), QSizeF(7.6, 7.6)));
      break;
  }
}

class EventDelegate : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;

  QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    const auto* view = qobject_cast<const QListWidget*>(option.widget);
    // As if the scroll bar were there: it comes later, and then lines must not need more room than they have.
    const int width = std::max(80, (view ? view->width() - kScrollBar : 270) - kTextLeft - 8);
    const QRect box = QFontMetrics(theme::uiFont(8.4))
                          .boundingRect(QRect(0, 0, width, 1000), Qt::TextWordWrap, index.data().toString());
    return {100, box.height() + 7};
  }

  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    const QRect r = option.rect;
    painter->setRenderHint(QPainter::Antialiasing);
    if (option.state & QStyle::State_Selected) painter->fillRect(r, theme::kRaised);
    paintSign(*painter, QPointF(r.left() + 16, r.top() + 11),
              static_cast<Severity>(index.data(kSeverityRole).toInt()));
    painter->setFont(theme::monoFont(7.8));
    painter->setPen(theme::kMuted);
    painter->drawText(QRect(r.left() + 28, r.top() + 2, kTextLeft - 30, 18), Qt::AlignVCenter,
                      index.data(kTimeRole).toString());
    painter->setFont(theme::uiFont(8.4));
    painter->setPen(theme::kText);
    const auto* view = qobject_cast<const QListWidget*>(option.widget);
    const int room = std::min(r.width(), view ? view->width() - kScrollBar : r.width()) - kTextLeft - 8;
    painter->drawText(QRect(r.left() + kTextLeft, r.top() + 3, room, r.height() - 4), Qt::TextWordWrap,
                      index.data().toString());
  }
};

}  // namespace

EventList::EventList(QWidget* parent) : QListWidget(parent) {
  setItemDelegate(new EventDelegate(this));
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
  setResizeMode(QListView::Adjust);
  setFrameShape(QFrame::NoFrame);
  setAccessibleName(tr("Events"));
}

void EventList::add(const EngineEvent& event) {
  if (event.time < last_) clear();  // a recording was wound back
  last_ = event.time;
  const bool at_end = verticalScrollBar()->value() == verticalScrollBar()->maximum();
  auto* item = new QListWidgetItem(QString::fromUtf8(event.text.data()));
  item->setData(kSeverityRole, static_cast<int>(event.severity));
  item->setData(kTimeRole, clockText(event.time));
  addItem(item);
  if (count() > kLongestList) delete takeItem(0);
  // Someone who scrolled back is reading.
  if (at_end) scrollToBottom();
}

}  // namespace helical
