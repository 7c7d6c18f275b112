#include "ui/playback_time_line.h"

#include <QHelpEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>
#include <cmath>

#include "ui/theme.h"

namespace helical {
namespace {

constexpr double kSide = 8.0;   // px beside the line
constexpr double kReach = 5.0;  // px from an event at which it is read

QColor colorOf(Severity severity) {
  switch (severity) {
    case Severity::kGood:
      return theme::kHealthy;
    case Severity::kCaution:
      return theme::kCaution;
    case Severity::kDanger:
      return theme::kDanger;
    case Severity::kInfo:
      break;
  }
  return theme::kMuted;
}

}  // namespace

QString playbackTime(TimeNs time) {
  const double seconds = toSeconds(time);
  const int minutes = static_cast<int>(seconds / 60.0);
  return QStringLiteral("%1:%2").arg(minutes).arg(seconds - 60.0 * minutes, 5, 'f', 2, QLatin1Char('0'));
}

PlaybackTimeLine::PlaybackTimeLine(FlightPlayback& playback, QWidget* parent)
    : QWidget(parent), playback_(playback) {
  setMinimumWidth(200);
  setAccessibleName(tr("Time line"));
  setCursor(Qt::PointingHandCursor);
}

double PlaybackTimeLine::xOf(TimeNs time) const {
  const auto length = static_cast<double>(playback_.end() - playback_.begin());
  return kSide + (width() - 2.0 * kSide) * static_cast<double>(time - playback_.begin()) / length;
}

TimeNs PlaybackTimeLine::timeAt(double x) const {
  const double share = std::clamp((x - kSide) / std::max(1.0, width() - 2.0 * kSide), 0.0, 1.0);
  const auto length = static_cast<double>(playback_.end() - playback_.begin());
  return playback_.begin() + static_cast<TimeNs>(std::llround(share * length));
}

void PlaybackTimeLine::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const double middle = 0.5 * height();
  const QRectF line(kSide, middle - 2.0, width() - 2.0 * kSide, 4.0);
  painter.fillRect(line, theme::kLine);
  if (const auto& loop = playback_.loop())
    painter.fillRect(
        QRectF(QPointF(xOf(loop->from), line.top() - 3.0), QPointF(xOf(loop->to), line.bottom() + 3.0)),
        theme::kLine);
  const double now = xOf(playback_.position());
  painter.fillRect(QRectF(line.topLeft(), QPointF(now, line.bottom())), theme::kActive);
  for (const EngineEvent& event : playback_.events()) {
    const double x = xOf(event.time);
    painter.setPen(QPen(colorOf(event.severity), 2.0));
    painter.drawLine(QPointF(x, middle - 11.0), QPointF(x, middle - 4.0));
  }
  painter.setPen(Qt::NoPen);
  painter.setBrush(theme::kActive);
  painter.drawEllipse(QPointF(now, middle), 6.0, 6.0);
}

void PlaybackTimeLine::mousePressEvent(QMouseEvent* event) {
  playback_.seek(timeAt(event->position().x()));
  update();
}

void PlaybackTimeLine::mouseMoveEvent(QMouseEvent* event) {
  if ((event->buttons() & Qt::LeftButton) == 0) return;
  playback_.seek(timeAt(event->position().x()));
  update();
}

bool PlaybackTimeLine::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip) return QWidget::event(event);
  const auto* help = static_cast<QHelpEvent*>(event);
  QString words;
  for (const EngineEvent& one : playback_.events())
    if (std::abs(xOf(one.time) - help->pos().x()) <= kReach)
      words += (words.isEmpty() ? "" : "\n") + playbackTime(one.time - playback_.begin()) +
               QStringLiteral("  ") + QString::fromUtf8(one.text.data());
  if (words.isEmpty())
    QToolTip::hideText();
  else
    QToolTip::showText(help->globalPos(), words, this);
  return true;
}

}  // namespace helical
