#pragma once

#include <QColor>
#include <QString>
#include <cstdint>
#include <vector>

#include "engine/config/rig_config.h"
#include "ui/tick_history.h"

namespace helical {

/// A stretch of time in which something was done to a camera or to the air.
struct PlotSpan {
  double begin = 0.0;  ///< s
  double end = 0.0;    ///< the same: a moment
  QColor color;
  QString text;
};

/// Rows of the history that are drawn.
struct PlotRows {
  std::int64_t begin = 0, end = 0;
  std::int64_t step = 1;
};

/// Cameras covered, disturbed and knocked, and gusts, as the operator ordered them.
std::vector<PlotSpan> findSpans(const RigConfig& rig, const TickHistory& history, const PlotRows& rows);

}  // namespace helical
