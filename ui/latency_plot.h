#pragma once

#include <QWidget>
#include <vector>

#include "engine/config/rig_config.h"
#include "ui/tick_history.h"

namespace helical {

/// How long frames were on their way from mid-exposure to their use, over the shown time: one histogram a
/// camera, with its median and its 99th percentile.
class LatencyPlot : public QWidget {
  Q_OBJECT

 public:
  struct Histogram {
    std::vector<int> bins;  ///< of `kBinMs` each
    int count = 0;
    double median_ms = 0.0;
    double p99_ms = 0.0;
  };
  static constexpr double kBinMs = 0.5;
  static constexpr double kLongestMs = 100.0;  ///< longer ones count in the last bin

  LatencyPlot(const RigConfig& rig, const TickHistory& history, QWidget* parent = nullptr);

  /// Counts the ticks between two times [s].
  void show(double begin, double end);
  /// By the suffix: png, pdf, or csv. False if it cannot be written.
  bool save(const QString& path);
  const Histogram& histogram(int camera) const { return histograms_[static_cast<std::size_t>(camera)]; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;

 private:
  int shownBins() const;
  QString table() const;

  const RigConfig& rig_;
  const TickHistory& history_;
  std::vector<Histogram> histograms_;
};

}  // namespace helical
