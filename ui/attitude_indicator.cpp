#include "ui/attitude_indicator.h"

#include <QPainter>
#include <QPainterPath>
#include <cmath>

#include "engine/geometry/rotation.h"
#include "ui/format.h"
#include "ui/theme.h"

namespace helical {
namespace {

constexpr double kPixelsPerDegree = 2.4;
constexpr double kBandAboveAndBelow = 60.0;  // degrees that are painted
const QColor kSky(0x1c, 0x4a, 0x74);
const QColor kGround(0x5a, 0x40, 0x2a);
const QColor kMark(0xe8, 0xee, 0xf4);

}  // namespace

AttitudeIndicator::AttitudeIndicator(QWidget* parent) : QWidget(parent) {
  setAccessibleName(tr("Attitude"));
  setToolTip(tr("Roll, pitch and heading of the helicopter as tracked"));
}

void AttitudeIndicator::show(const EngineSnapshot& snapshot) {
  known_ = snapshot.pose_known;
  const Eigen::Matrix3d r = snapshot.tracked.state.world_from_body.rotation.toRotationMatrix();
  // Body x forward, y left, z up: the nose's height over the horizon, and how far the left side is above it.
  pitch_deg_ = toDegrees(std::asin(std::clamp(r(2, 0), -1.0, 1.0)));
  roll_deg_ = toDegrees(std::atan2(r(2, 1), r(2, 2)));
  yaw_deg_ = toDegrees(std::atan2(r(1, 0), r(0, 0)));
  update();
}

void AttitudeIndicator::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), theme::kPanel);
  const double radius = 0.5 * std::min(height() - 14.0, 0.56 * width());
  const QPointF center(14.0 + radius, height() / 2.0);
  if (known_) paintBall(painter, center, radius);
  paintBank(painter, center, radius);
  paintNumbers(painter);
}

void AttitudeIndicator::paintBall(QPainter& painter, const QPointF& center, double radius) const {
  painter.save();
  QPainterPath disc;
  disc.addEllipse(center, radius, radius);
  painter.setClipPath(disc);
  painter.translate(center);
  painter.rotate(-roll_deg_);
  painter.translate(0.0, pitch_deg_ * kPixelsPerDegree);
  const double reach = radius + kBandAboveAndBelow * kPixelsPerDegree + 300.0;
  painter.fillRect(QRectF(-reach, -reach, 2.0 * reach, reach), kSky);
  painter.fillRect(QRectF(-reach, 0.0, 2.0 * reach, reach), kGround);
  painter.setPen(QPen(kMark, 1.4));
  painter.drawLine(QPointF(-reach, 0.0), QPointF(reach, 0.0));
  painter.setFont(theme::monoFont(6.6));
  for (int degrees = -40; degrees <= 40; degrees += 10) {
    if (degrees == 0) continue;
    const double y = -degrees * kPixelsPerDegree, half = degrees % 20 == 0 ? 17.0 : 10.0;
    painter.setPen(QPen(QColor(232, 238, 244, 170), 1.0));
    painter.drawLine(QPointF(-half, y), QPointF(half, y));
    if (degrees % 20 == 0)
      painter.drawText(QRectF(half + 3.0, y - 7.0, 24.0, 14.0), Qt::AlignVCenter,
                       QString::number(std::abs(degrees)));
  }
  painter.restore();
}

void AttitudeIndicator::paintBank(QPainter& painter, const QPointF& center, double radius) const {
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(theme::kLine.lighter(140), 2.0));
  painter.drawEllipse(center, radius, radius);
  painter.save();
  painter.translate(center);
  for (const int degrees : {-60, -45, -30, -20, -10, 0, 10, 20, 30, 45, 60}) {
    painter.save();
    painter.rotate(degrees);
    painter.setPen(QPen(theme::kMuted, degrees % 30 == 0 ? 1.6 : 1.0));
    painter.drawLine(QPointF(0.0, -radius), QPointF(0.0, -radius + (degrees % 30 == 0 ? 7.0 : 4.0)));
    painter.restore();
  }
  // The helicopter itself stands still in the middle.
  painter.setPen(QPen(theme::kCaution, 2.2, Qt::SolidLine, Qt::RoundCap));
  painter.drawLine(QPointF(-0.42 * radius, 0.0), QPointF(-0.16 * radius, 0.0));
  painter.drawLine(QPointF(0.16 * radius, 0.0), QPointF(0.42 * radius, 0.0));
  painter.drawEllipse(QPointF(0.0, 0.0), 2.4, 2.4);
  if (known_) {
    painter.rotate(-roll_deg_);
    painter.setPen(Qt::NoPen);
    painter.setBrush(theme::kCaution);
    painter.drawPolygon(QPolygonF{{0.0, -radius + 8.0}, {-4.5, -radius + 15.0}, {4.5, -radius + 15.0}});
  }
  painter.restore();
}

void AttitudeIndicator::paintNumbers(QPainter& painter) const {
  const double radius = 0.5 * std::min(height() - 14.0, 0.56 * width());
  const int left = static_cast<int>(26.0 + 2.0 * radius), right = width() - 14;
  const struct {
    QString name;
    double value;
  } rows[] = {{tr("Roll"), roll_deg_}, {tr("Pitch"), pitch_deg_}, {tr("Heading"), yaw_deg_}};
  int y = height() / 2 - 54;
  for (const auto& row : rows) {
    painter.setFont(theme::uiFont(7.8));
    painter.setPen(theme::kMuted);
    painter.drawText(QRect(left, y, right - left, 15), Qt::AlignVCenter | Qt::AlignRight, row.name);
    painter.setFont(theme::monoFont(10.2, QFont::Medium));
    painter.setPen(theme::kText);
    painter.drawText(QRect(left, y + 15, right - left, 18), Qt::AlignVCenter | Qt::AlignRight,
                     known_ ? signedNumber(row.value, 1) + QChar(0x00b0) : kNoValue);
    y += 37;
  }
}

}  // namespace helical
