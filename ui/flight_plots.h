#pragma once

#include <QWidget>
#include <array>

#include "engine/pipeline/snapshot.h"

class QCPAxisRect;
class QCPGraph;
class QCPItemText;
class QCustomPlot;

namespace helical {

/// x, y, z and yaw of the helicopter with their references over the last half minute, on one time axis.
class FlightPlots : public QWidget {
  Q_OBJECT

 public:
  explicit FlightPlots(QWidget* parent = nullptr);

  /// Every control tick, in order: plots must not miss one.
  void addTick(const EngineSnapshot& tick);
  /// Redraws up to `now`.
  void redraw(TimeNs now);

  static constexpr int kSeries = 4;
  /// Points now held of one series (x, y, z, yaw).
  int pointCount(int series) const;

 private:
  struct Series {
    QCPAxisRect* rect = nullptr;
    QCPGraph* measured = nullptr;
    QCPGraph* reference = nullptr;
    double smallest_span = 0.0;
  };

  void addSeries(int index);
  void fitRange(Series& series, double from);

  QCustomPlot* plot_;
  std::array<Series, kSeries> series_;
  double yaw_deg_ = 0.0;  ///< unwrapped
};

}  // namespace helical
