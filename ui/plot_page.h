#pragma once

#include <QColor>
#include <QString>
#include <Qt>
#include <cstdint>
#include <vector>

#include "engine/config/rig_config.h"
#include "ui/tick_history.h"

namespace helical {

/// One line of a plot: a column of the tick history, or with `bit` a bar at height `level` while that bit of
/// the column is set.
struct PlotSeries {
  QString name;  ///< in the lane's heading; empty for none
  QString column_name;  ///< in tables, where `name` does not say enough
  int column = 0;
  double scale = 1.0;  ///< from the column's unit to the lane's
  QColor color;
  Qt::PenStyle style = Qt::SolidLine;
  double width = 1.5;
  int bit = -1;
  double level = 0.0;
  /// Only where this column of the history has this value; negative: everywhere.
  int condition = -1;
  double condition_value = 0.0;
};

/// What a line shows of a row: not a number for nothing.
double valueOf(const PlotSeries& series, const TickHistory& history, std::int64_t row);

/// A word on the value axis instead of a number.
struct PlotLevel {
  double value = 0.0;
  QString name;
};

/// One set of axes. Values on a linear axis cover at least `smallest_span`.
struct PlotLane {
  QString title;
  QString unit;
  std::vector<PlotSeries> series;
  double smallest_span = 1.0;
  int decimals = 2;
  bool logarithmic = false;
  bool one_sided = false;         ///< values are never negative: the axis begins at 0
  QString empty;                  ///< what to say while there is nothing to draw
  std::vector<PlotLevel> levels;  ///< fixes the axis: from half below the first to half above the last
};

/// What one sheet of plots shows: its lanes row by row.
struct PlotPage {
  QString name;
  QString tip;
  int columns = 2;
  std::vector<PlotLane> lanes;
  QString empty;  ///< what to say without any lane
};

/// Helicopter x, y, z and yaw with their references.
PlotPage flightPage();
/// Error of the pose where the truth is known, its sigma, sticks and latencies.
PlotPage trackingPage(const RigConfig& rig, const TickHistory& history);
/// Position and orientation of the cameras that are calibrated in flight: error and sigma, effective sample
/// size, reprojection residual.
PlotPage calibrationPage(const RigConfig& rig, const TickHistory& history);
/// De, or misfit, of the best labellings that the cameras' calibrations have weighed up.
PlotPage labellingPage(const RigConfig& rig, const TickHistory& history);
/// Which features were used for the pose (the paper's figures 8 and 11).
PlotPage featurePage(const RigConfig& rig, const TickHistory& history);

}  // namespace helical
