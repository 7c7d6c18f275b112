#include "ui/event_list.h"

#include <QPainter>
#include <QScrollBar>
#include <QStyledItemDelegate>
#include <algorithm>

#include "ui/catalogue.h"
#include "ui/format.h"
#include "ui/theme.h"

namespace helical {
namespace {

constexpr int kLongestList = 1000;
constexpr int kScrollBar = 10;
constexpr int kTextLeft = 82;
constexpr int kSeverityRole = Qt::UserRole;
constexpr int kTimeRole = Qt::UserRole + 1;
constexpr int kSeenRole = Qt::UserRole + 2;

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
    const bool danger = index.data(kSeverityRole).toInt() == static_cast<int>(Severity::kDanger);
    const bool open = danger && !index.data(kSeenRole).toBool();
    if (danger && !open) {
      painter->setPen(QPen(theme::kHealthy, 1.6, Qt::SolidLine, Qt::RoundCap));
      const QPointF tick(r.left() + 16, r.top() + 11);
      painter->drawPolyline(QPolygonF{tick + QPointF(1, 2), tick + QPointF(3, 5), tick + QPointF(8, -3)});
    }
    painter->setFont(theme::uiFont(8.4, open ? QFont::DemiBold : QFont::Normal));
    painter->setPen(open ? theme::kDanger.lighter(125) : theme::kText);
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
  setToolTip(tr("What happened, newest at the bottom"));
}

void EventList::add(const EngineEvent& event) {
  if (event.time < last_) clear();  // a recording was wound back
  last_ = event.time;
  const bool at_end = verticalScrollBar()->value() == verticalScrollBar()->maximum();
  auto* item = new QListWidgetItem(engineText(QString::fromUtf8(event.text.data())));
  item->setData(kSeverityRole, static_cast<int>(event.severity));
  item->setData(kTimeRole, clockText(event.time));
  addItem(item);
  item->setHidden(!passes(*item));
  if (count() > kLongestList) delete takeItem(0);
  // Someone who scrolled back is reading.
  if (at_end) scrollToBottom();
}

bool EventList::passes(const QListWidgetItem& item) const {
  const bool wanted = (severities_ >> item.data(kSeverityRole).toUInt() & 1U) != 0;
  if (!wanted) return false;
  for (const QString& word : words_.split(QLatin1Char(' '), Qt::SkipEmptyParts))
    if (!item.text().contains(word, Qt::CaseInsensitive)) return false;
  return true;
}

void EventList::filter(unsigned severities, const QString& words) {
  severities_ = severities;
  words_ = words;
  for (int i = 0; i < count(); ++i) item(i)->setHidden(!passes(*item(i)));
  scrollToBottom();
}

void EventList::acknowledge() {
  for (int i = 0; i < count(); ++i) item(i)->setData(kSeenRole, true);
}

int EventList::shownCount() const {
  int shown = 0;
  for (int i = 0; i < count(); ++i) shown += !item(i)->isHidden();
  return shown;
}

int EventList::unacknowledgedCount() const {
  int open = 0;
  for (int i = 0; i < count(); ++i)
    open += item(i)->data(kSeverityRole).toInt() == static_cast<int>(Severity::kDanger) &&
            !item(i)->data(kSeenRole).toBool();
  return open;
}

QIcon EventList::sign(Severity severity) {
  QPixmap pixmap(32, 32);
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.scale(2.2, 2.2);
  paintSign(painter, QPointF(7.2, 7.2), severity);
  return QIcon(pixmap);
}

}  // namespace helical
