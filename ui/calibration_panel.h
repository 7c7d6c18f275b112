#pragma once

#include <QWidget>
#include <string>
#include <vector>

#include "engine/config/rig_config.h"
#include "engine/pipeline/snapshot.h"

class QComboBox;
class QLabel;

namespace helical {

class HeatMaps;

/// The cameras that find their place in flight: by which method, how far they are. A choice only asks; shown
/// is what the engine says.
class CalibrationPanel : public QWidget {
  Q_OBJECT

 public:
  CalibrationPanel(const RigConfig& rig, const std::vector<std::string>& methods, QWidget* parent = nullptr);

  void show(const EngineSnapshot& snapshot);
  /// Every control tick: the maps must not miss a frame.
  void addTick(const EngineSnapshot& tick);
  const HeatMaps& maps(int camera) const { return *rows_[static_cast<std::size_t>(camera)].maps; }
  /// How many hypotheses a camera's method has; 0 for none.
  void setHypotheses(int camera, int total);

  QComboBox* methods() const { return methods_; }
  /// The word that is shown for a camera; empty for one that does not learn.
  QString state(int camera) const;

 Q_SIGNALS:
  void methodChosen(const QString& method);
  void restartRequested(helical::CameraId camera);

 private:
  struct Row {
    int camera = 0;
    QWidget* box = nullptr;
    int hypotheses = 0;
    QLabel* state = nullptr;
    QLabel* position_sigma = nullptr;
    QLabel* position_error = nullptr;
    QLabel* orientation_sigma = nullptr;
    QLabel* orientation_error = nullptr;
    QLabel* effective = nullptr;
    HeatMaps* maps = nullptr;
  };
  QWidget* buildRow(const CameraConfig& config, int camera);
  static void showRow(const Row& row, const EngineSnapshot& snapshot);

  void showOnlyLearners();

  QComboBox* methods_;
  QLabel* nobody_;
  std::vector<Row> rows_;  ///< of all cameras; those that never learnt are not shown
};

}  // namespace helical
