#pragma once

#include <QWidget>
#include <vector>

#include "engine/config/rig_config.h"
#include "ui/tick_history.h"
#include "ui/time_axis.h"

class QActionGroup;
class QStackedWidget;

namespace helical {

class LatencyPlot;
class PanelTitle;
class TimePlots;

/// The sheets of plots, one shown at a time, all on one time axis and one history.
class PlotDeck : public QWidget {
  Q_OBJECT

 public:
  /// `rig` must outlive this.
  explicit PlotDeck(const RigConfig& rig, QWidget* parent = nullptr);

  enum Sheet { kFlight, kCalibration, kLabels, kFeatures, kTracking, kLatency };

  /// Buttons of the sheets and of Live, for the panel's title.
  void addControls(PanelTitle& title);

  /// Every control tick, in order: plots must not miss one.
  void addTick(const EngineSnapshot& tick) { history_.add(tick); }
  /// Redraws the shown sheet up to the newest tick.
  void redraw();

  void showSheet(Sheet sheet);
  /// Not of kLatency, which is no function of time.
  TimePlots& sheet(Sheet sheet) const { return *sheets_[static_cast<std::size_t>(sheet)]; }
  LatencyPlot& latency() const { return *latency_; }
  TimeAxis& axis() { return axis_; }
  const TickHistory& history() const { return history_; }

 private:
  void addSheet(QWidget* sheet, const QString& name, const QString& tip);

  TickHistory history_;
  TimeAxis axis_;
  QStackedWidget* stack_;
  QActionGroup* choice_;
  std::vector<TimePlots*> sheets_;
  LatencyPlot* latency_;
};

}  // namespace helical
