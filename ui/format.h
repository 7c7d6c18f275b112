#pragma once

#include <QString>

#include "engine/base/time.h"

namespace helical {

/// What the window writes where the engine has no value.
inline const QString kNoValue = QStringLiteral("\u2013");

/// A signed number with a true minus sign, "+0.600"; never "-0.000".
QString signedNumber(double value, int decimals);

/// A number without sign for values that cannot be negative.
QString plainNumber(double value, int decimals);

/// A duration in milliseconds, "0.42"; a dash for zero, which the engine uses for "none yet".
QString milliseconds(TimeNs duration, int decimals);

/// "00:07.3": minutes, seconds, tenths.
QString clockText(TimeNs time);

}  // namespace helical
