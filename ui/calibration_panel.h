#pragma once

#include <QWidget>
#include <string>
#include <vector>

#include "engine/config/rig_config.h"
#include "engine/pipeline/calibration_order.h"
#include "engine/pipeline/snapshot.h"

class QComboBox;
class QHBoxLayout;
class QLabel;
class QToolButton;

namespace helical {

class CalibrationRow;
class HeatMaps;

/// The cameras that find their place in flight: by which method, how far they are; where all stand to and
/// from a file. A choice only asks; shown is what the engine says.
class CalibrationPanel : public QWidget {
  Q_OBJECT

 public:
  CalibrationPanel(const RigConfig& rig, const std::vector<std::string>& methods, QWidget* parent = nullptr);

  void show(const EngineSnapshot& snapshot);
  /// Every control tick: the maps must not miss a frame.
  void addTick(const EngineSnapshot& tick);
  const HeatMaps& maps(int camera) const;
  /// How many hypotheses a camera's method has; 0 for none.
  void setHypotheses(int camera, int total);
  /// Off where there is no engine to ask: in a recorded flight.
  void setCommands(bool possible);

  QComboBox* methods() const { return methods_; }
  QToolButton* refineButton() const { return refine_; }
  QToolButton* loadButton() const { return load_; }
  QToolButton* saveButton() const { return save_; }
  const CalibrationRow& row(int camera) const { return *rows_[static_cast<std::size_t>(camera)]; }
  /// The word that is shown for a camera; empty for one that does not learn.
  QString state(int camera) const;

 Q_SIGNALS:
  void methodChosen(const QString& method);
  void restartRequested(helical::CameraId camera);
  void ordered(helical::CameraId camera, helical::CalibrationOrderKind kind);
  void loadRequested();
  void saveRequested();
  void placeLoadRequested(helical::CameraId camera);
  void placeSaveRequested(helical::CameraId camera);

 private:
  QHBoxLayout* buildMethods(const RigConfig& rig, const std::vector<std::string>& methods);
  QHBoxLayout* buildFiles();
  void showOnlyLearners();

  QComboBox* methods_;
  QToolButton* refine_ = nullptr;
  QToolButton* load_ = nullptr;
  QToolButton* save_ = nullptr;
  QLabel* nobody_ = nullptr;
  bool commands_ = true;
  std::vector<CalibrationRow*> rows_;  ///< of all cameras; those that never learnt are not shown
};

}  // namespace helical
