#include "ui/alarm_bar.h"

#include <QApplication>
#include <QHBoxLayout>
#include <QPainter>
#include <QPushButton>
#include <algorithm>
#include <cmath>

#include "engine/geometry/rotation.h"
#include "ui/catalogue.h"
#include "ui/format.h"
#include "ui/theme.h"

namespace helical {
namespace {

constexpr int kHeight = 44;
constexpr int kWidth = 640;
constexpr std::size_t kMostAlarms = 100;

}  // namespace

AlarmBar::AlarmBar(QWidget* parent) : QWidget(parent), button_(new QPushButton(tr("Acknowledge"))) {
  setAccessibleName(tr("Alarm"));
  button_->setObjectName(QStringLiteral("acknowledge"));
  button_->setFont(theme::uiFont(9, QFont::DemiBold));
  button_->setToolTip(tr("I have seen it"));
  button_->setAccessibleName(tr("Acknowledge the alarm"));
  button_->setFocusPolicy(Qt::TabFocus);
  button_->setAutoDefault(false);
  connect(button_, &QPushButton::clicked, this, &AlarmBar::acknowledge);
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(0, 0, 10, 0);
  layout->addStretch(1);
  layout->addWidget(button_);
  hide();
}

void AlarmBar::add(const EngineEvent& event) {
  if (event.severity != Severity::kDanger) return;
  const QString text = engineText(QString::fromUtf8(event.text.data()));
  const auto last = last_raised_.constFind(text);
  if (last != last_raised_.constEnd() && event.time - *last < kSilence) return;
  last_raised_[text] = event.time;
  alarms_.push_back({event.time, text});
  if (alarms_.size() > kMostAlarms) alarms_.pop_front();
  if (sound_) QApplication::beep();
  show();
  raise();
  update();
}

void AlarmBar::acknowledge() {
  alarms_.clear();
  hide();
  Q_EMIT acknowledged();
}

QString AlarmBar::text() const {
  return alarms_.empty() ? QString() : alarms_.back().text;
}

void AlarmBar::place(int top) {
  const int width = std::min(kWidth, parentWidget()->width() - 40);
  setGeometry((parentWidget()->width() - width) / 2, top, width, kHeight);
}

void AlarmBar::paintEvent(QPaintEvent*) {
  if (alarms_.empty()) return;
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(theme::kDanger, 1.5));
  painter.setBrush(QColor(0x5a, 0x12, 0x16));
  painter.drawRoundedRect(QRectF(rect()).adjusted(1, 1, -1, -1), 5, 5);
  // A sign of its own shape: an octagon with a bar.
  const QPointF center(24, height() / 2.0);
  QPolygonF octagon;
  for (int i = 0; i < 8; ++i) {
    const double angle = (i + 0.5) * kPi / 4.0;
    octagon << center + 11.0 * QPointF(std::cos(angle), std::sin(angle));
  }
  painter.setPen(Qt::NoPen);
  painter.setBrush(Qt::white);
  painter.drawPolygon(octagon);
  painter.setBrush(theme::kDanger);
  painter.drawRoundedRect(QRectF(center.x() - 1.5, center.y() - 6.5, 3, 8), 1, 1);
  painter.drawEllipse(QPointF(center.x(), center.y() + 5), 1.7, 1.7);

  painter.setPen(QColor(0xff, 0xc9, 0xca));
  painter.setFont(theme::monoFont(8.4));
  painter.drawText(QRect(46, 0, 64, height()), Qt::AlignVCenter, clockText(alarms_.back().time));
  QString shown = alarms_.back().text;
  if (alarms_.size() > 1) shown += tr("   (and %1 more)").arg(alarms_.size() - 1);
  painter.setPen(Qt::white);
  painter.setFont(theme::uiFont(9.6, QFont::DemiBold));
  const int room = button_->x() - 112 - 8;
  painter.drawText(QRect(112, 0, room, height()), Qt::AlignVCenter,
                   painter.fontMetrics().elidedText(shown, Qt::ElideRight, room));
}

}  // namespace helical
