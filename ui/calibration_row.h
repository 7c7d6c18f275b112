#pragma once

#include <QWidget>
#include <array>

#include "engine/config/rig_config.h"
#include "engine/pipeline/calibration_order.h"
#include "engine/pipeline/snapshot.h"

class QLabel;
class QToolButton;

namespace helical {

class HeatMaps;

/// How far one camera is with finding its place, and what an operator may decide about it. Buttons only ask;
/// what came of it the next snapshot tells, and an event why not.
class CalibrationRow : public QWidget {
  Q_OBJECT

 public:
  CalibrationRow(const CameraConfig& config, int camera, QWidget* parent = nullptr);

  /// Every control tick: the maps must not miss a frame.
  void addTick(const EngineSnapshot& tick);
  void show(const EngineSnapshot& snapshot);
  /// How many hypotheses the camera's method has; 0 for none.
  void setHypotheses(int total) { hypotheses_ = total; }

  QString state() const;
  const HeatMaps& maps() const { return *maps_; }
  QToolButton* acceptButton() const { return accept_; }
  QToolButton* freezeButton() const { return freeze_; }  ///< resumes a frozen one
  QToolButton* restartButton() const { return restart_; }
  QToolButton* rigButton() const { return rig_; }  ///< hidden where the rig file gives no place
  QToolButton* loadButton() const { return load_; }
  QToolButton* saveButton() const { return save_; }
  /// Which balls it takes for which, and how that labelling fares; empty while it does not know.
  QString labelling() const;

 Q_SIGNALS:
  void ordered(helical::CameraId camera, helical::CalibrationOrderKind kind);
  void restartRequested(helical::CameraId camera);
  void loadRequested(helical::CameraId camera);
  void saveRequested(helical::CameraId camera);

 private:
  QWidget* buildButtons(const CameraConfig& config, const QString& name);
  void makeButtons(const QString& name);
  void connectButtons();
  void showLabelling(const TriedLabellings& tried);
  void showNumbers(const CameraSnapshot& state);
  void showButtons(const CameraSnapshot& state);

  const int camera_;
  int hypotheses_ = 0;
  bool frozen_ = false;
  QLabel* state_;
  std::array<QLabel*, 3> position_;     ///< sigma, bound, error
  std::array<QLabel*, 3> orientation_;  ///< likewise
  QLabel* effective_name_;
  QLabel* effective_;
  QLabel* labelling_name_;
  QLabel* labelling_;
  HeatMaps* maps_;
  QToolButton* accept_ = nullptr;
  QToolButton* freeze_ = nullptr;
  QToolButton* restart_ = nullptr;
  QToolButton* rig_ = nullptr;
  QToolButton* load_ = nullptr;
  QToolButton* save_ = nullptr;
};

}  // namespace helical
