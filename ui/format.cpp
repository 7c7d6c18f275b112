#include "ui/format.h"

#include <algorithm>
#include <cmath>

namespace helical {

QString signedNumber(double value, int decimals) {
  const double unit = std::pow(10.0, -decimals);
  const bool negative = value <= -0.5 * unit;
  return (negative ? QChar(0x2212) : QChar('+')) + QString::number(std::abs(value), 'f', decimals);
}

QString plainNumber(double value, int decimals) {
  return QString::number(std::max(0.0, value), 'f', decimals);
}

QString milliseconds(TimeNs duration, int decimals) {
  if (duration <= 0) return kNoValue;
  return QString::number(toSeconds(duration) * 1e3, 'f', decimals);
}

QString clockText(TimeNs time) {
  const TimeNs tenths = std::max<TimeNs>(0, time) / (kNanosecondsPerSecond / 10);
  return QStringLiteral("%1:%2.%3")
      .arg(tenths / 600, 2, 10, QChar('0'))
      .arg(tenths / 10 % 60, 2, 10, QChar('0'))
      .arg(tenths % 10);
}

}  // namespace helical
