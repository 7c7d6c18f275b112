#include "ui/flight_panel.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "engine/geometry/rotation.h"
#include "ui/format.h"
#include "ui/status_words.h"
#include "ui/theme.h"

namespace helical {
namespace {

constexpr int kMargin = 14;
constexpr int kRow = 21;
constexpr int kUnitWidth = 34;
constexpr int kNumberWidth = 72;
constexpr int kSheetHeight = 560;

}  // namespace

/// Writes rows from top to bottom.
class FlightPanel::Sheet {
 public:
  Sheet(QPainter& painter, int width) : painter_(painter), width_(width) {}

  void heading(const QString& text, const QString& first_column = {}, const QString& second_column = {}) {
    y_ += y_ > 8 ? 9 : 0;
    painter_.setFont(theme::capsFont(7.0));
    painter_.setPen(theme::kMuted);
    painter_.drawText(QRect(kMargin, y_, width_ - 2 * kMargin, 18), Qt::AlignVCenter, text);
    painter_.setFont(theme::uiFont(7.6));
    painter_.setPen(theme::kFaint);
    painter_.drawText(column(1, 18), Qt::AlignVCenter | Qt::AlignRight, first_column);
    painter_.drawText(column(0, 18), Qt::AlignVCenter | Qt::AlignRight, second_column);
    painter_.setPen(theme::kLine);
    painter_.drawLine(QPointF(kMargin, y_ + 18.5), QPointF(width_ - kMargin, y_ + 18.5));
    y_ += 22;
  }

  void words(const QString& name, const QString& value, const QColor& color) {
    label(name);
    painter_.setFont(theme::uiFont(8.8, QFont::DemiBold));
    painter_.setPen(color);
    const int left = kMargin + 84;
    const QString shown = painter_.fontMetrics().elidedText(value, Qt::ElideRight, width_ - kMargin - left);
    painter_.drawText(QRect(left, y_, width_ - kMargin - left, kRow), Qt::AlignVCenter | Qt::AlignRight,
                      shown);
    y_ += kRow;
  }

  void number(const QString& name, const QString& value, const QString& unit_text,
              const QColor& color = theme::kText) {
    label(name);
    value_(column(0, kRow), value, color);
    unit(unit_text);
    y_ += kRow;
  }

  void pair(const QString& name, const QString& first, const QString& second, const QString& unit_text) {
    label(name);
    value_(column(1, kRow), first, theme::kText);
    value_(column(0, kRow), second, theme::kMuted);
    unit(unit_text);
    y_ += kRow;
  }

  /// A bar from 0 to 1, or about the middle for -1 to 1.
  void bar(const QString& name, double value, bool two_sided, bool known) {
    label(name);
    value_(column(0, kRow),
           known ? (two_sided ? signedNumber(100 * value, 0) : plainNumber(100 * value, 0)) : kNoValue,
           theme::kText);
    unit(QStringLiteral("%"));
    const double left = kMargin + 84, right = width_ - kMargin - kUnitWidth - 44;
    const QRectF groove(left, y_ + kRow / 2.0 - 2, right - left, 4);
    painter_.setPen(Qt::NoPen);
    painter_.setBrush(theme::kLine);
    painter_.drawRoundedRect(groove, 2, 2);
    painter_.setBrush(theme::kActive);
    if (known && two_sided) {
      const double middle = groove.center().x(),
                   tip = middle + 0.5 * groove.width() * std::clamp(value, -1.0, 1.0);
      painter_.drawRoundedRect(QRectF(QPointF(std::min(middle, tip), groove.top()),
                                      QPointF(std::max(middle, tip), groove.bottom())),
                               1, 1);
      painter_.setBrush(theme::kMuted);
      painter_.drawRect(QRectF(middle - 0.5, groove.top() - 3, 1, groove.height() + 6));
    } else if (known) {
      painter_.drawRoundedRect(
          QRectF(groove.topLeft(), QSizeF(groove.width() * std::clamp(value, 0.0, 1.0), groove.height())), 2,
          2);
    }
    y_ += kRow;
  }

 private:
  QRect column(int from_right, int height) const {
    return {width_ - kMargin - kUnitWidth + 2 - (from_right + 1) * kNumberWidth, y_, kNumberWidth, height};
  }
  void label(const QString& name) {
    painter_.setFont(theme::uiFont(8.6));
    painter_.setPen(theme::kMuted);
    painter_.drawText(QRect(kMargin, y_, 120, kRow), Qt::AlignVCenter, name);
  }
  void value_(const QRect& where, const QString& text, const QColor& color) {
    painter_.setFont(theme::monoFont(9.2, QFont::Medium));
    painter_.setPen(color);
    painter_.drawText(where, Qt::AlignVCenter | Qt::AlignRight, text);
  }
  void unit(const QString& text) {
    painter_.setFont(theme::uiFont(7.8));
    painter_.setPen(theme::kFaint);
    painter_.drawText(QRect(width_ - kMargin - kUnitWidth + 8, y_, kUnitWidth, kRow), Qt::AlignVCenter, text);
  }

  QPainter& painter_;
  int width_;
  int y_ = 8;
};

FlightPanel::FlightPanel(QWidget* parent) : QWidget(parent) {
  setAttribute(Qt::WA_OpaquePaintEvent);
  setAccessibleName(tr("Flight state"));
}

void FlightPanel::show(const EngineSnapshot& snapshot) {
  snapshot_ = snapshot;
  filled_ = true;
  update();
}

QSize FlightPanel::sizeHint() const {
  return {272, kSheetHeight};
}
QSize FlightPanel::minimumSizeHint() const {
  return {250, kSheetHeight};
}

void FlightPanel::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), theme::kPanel);
  if (!filled_) {
    painter.setPen(theme::kMuted);
    painter.drawText(rect().adjusted(0, 40, 0, 0), Qt::AlignHCenter, tr("The engine is starting"));
    return;
  }
  Sheet sheet(painter, width());
  paintState(sheet);
  paintPosition(sheet);
  paintMotion(sheet);
  paintSticks(sheet);
  paintTiming(sheet);
}

void FlightPanel::paintState(Sheet& sheet) const {
  sheet.heading(tr("State"));
  const StatusWord phase = phaseWord(snapshot_.phase);
  const StatusWord safety = safetyWord(snapshot_.safety);
  const QString failsafes = failsafeNames(snapshot_.failsafes);
  sheet.words(tr("Phase"), phase.text, phase.color);
  sheet.words(tr("Safety"), safety.text, safety.color);
  sheet.words(tr("Failsafes"), failsafes.isEmpty() ? tr("none acted") : failsafes,
              failsafes.isEmpty() ? theme::kMuted : theme::kCaution);
}

void FlightPanel::paintPosition(Sheet& sheet) const {
  sheet.heading(tr("Position"), tr("now"), tr("set"));
  const RigidTransform& pose = snapshot_.tracked.state.world_from_body;
  const SetPoint& set = snapshot_.set_point;
  const bool known = snapshot_.pose_known, wanted = hasReference(snapshot_);
  const char* const names[] = {"X", "Y", "Z"};
  for (int i = 0; i < 3; ++i)
    sheet.pair(QString::fromLatin1(names[i]), known ? signedNumber(pose.translation[i], 3) : kNoValue,
               wanted ? signedNumber(set.position_in_world[i], 3) : kNoValue, tr("m"));
  sheet.pair(tr("Yaw"), known ? signedNumber(toDegrees(yawOf(pose.rotation)), 1) : kNoValue,
             wanted ? signedNumber(toDegrees(set.yaw), 1) : kNoValue, tr("deg"));
}

void FlightPanel::paintMotion(Sheet& sheet) const {
  const HelicopterState& state = snapshot_.tracked.state;
  const bool known = snapshot_.pose_known;
  sheet.heading(tr("Motion"));
  sheet.number(
      tr("Height above pad"),
      known ? signedNumber(state.world_from_body.translation.z() - snapshot_.pad_height, 3) : kNoValue,
      tr("m"));
  sheet.number(tr("Speed"), known ? plainNumber(state.velocity_in_world.norm(), 2) : kNoValue, tr("m/s"));
  sheet.number(tr("Tilt"),
               known ? plainNumber(toDegrees(tiltOf(state.world_from_body.rotation)), 1) : kNoValue,
               tr("deg"));
  const double sigma =
      std::sqrt(std::max(0.0, snapshot_.tracked.pose_covariance.topLeftCorner<3, 3>().trace()));
  sheet.number(tr("Position sigma"), known ? plainNumber(1e3 * sigma, 1) : kNoValue, tr("mm"));
  const bool stale = known && snapshot_.pose_age > 60 * kNanosecondsPerMillisecond;
  sheet.number(tr("Pose age"), known ? plainNumber(1e3 * toSeconds(snapshot_.pose_age), 0) : kNoValue,
               tr("ms"), stale ? theme::kCaution : theme::kText);
}

void FlightPanel::paintSticks(Sheet& sheet) const {
  sheet.heading(tr("Sticks"));
  sheet.bar(tr("Upper rotor"), snapshot_.sticks.upper_rotor, false, true);
  sheet.bar(tr("Lower rotor"), snapshot_.sticks.lower_rotor, false, true);
  sheet.bar(tr("Roll"), snapshot_.sticks.roll, true, true);
  sheet.bar(tr("Pitch"), snapshot_.sticks.pitch, true, true);
}

void FlightPanel::paintTiming(Sheet& sheet) const {
  sheet.heading(tr("Latency"), tr("median"), tr("99 %"));
  sheet.pair(tr("Server"), milliseconds(snapshot_.server_p50, 2), milliseconds(snapshot_.server_p99, 2),
             tr("ms"));
  sheet.pair(tr("To command"), milliseconds(snapshot_.frame_to_command_p50, 2),
             milliseconds(snapshot_.frame_to_command_p99, 2), tr("ms"));
  sheet.number(tr("Engine time"), clockText(snapshot_.time), {});
}

}  // namespace helical
