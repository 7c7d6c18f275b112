#pragma once

#include <QWidget>

#include "engine/config/rig_config.h"
#include "engine/pipeline/snapshot.h"

class QLabel;
class QMenuBar;
class QPushButton;

namespace helical {

class HoldButton;
class PreflightPopup;
class StatusChip;

/// The bar that is always there: name, menus, readiness in one word (a click opens the pre-flight list),
/// rates, transmitter, who flies, flight time, Arm (held down for a second), Take off, Hold, Land, STOP. Buttons only
/// ask; what is shown is what the engine answers.
class TopBar : public QWidget {
  Q_OBJECT

 public:
  /// `rig` must outlive this.
  explicit TopBar(const RigConfig& rig, QWidget* parent = nullptr);

  QMenuBar* menuBar() const { return menu_bar_; }
  HoldButton* armButton() const { return arm_; }
  QPushButton* holdButton() const { return hold_; }
  QPushButton* takeOffButton() const { return take_off_; }
  QPushButton* landButton() const { return land_; }
  QPushButton* stopButton() const { return stop_; }
  QPushButton* readinessButton() const { return readiness_; }
  PreflightPopup& preflight() const { return *preflight_; }
  QString readiness() const;
  /// Who flies, as it is shown.
  QString pilot() const;

  void show(const EngineSnapshot& snapshot);

 Q_SIGNALS:
  void armRequested(bool arm);
  void takeOffRequested();
  void holdRequested();
  void landRequested();
  void stopRequested();

 private:
  void buildButtons();
  void enableButtons(const EngineSnapshot& snapshot);
  void setReadiness(const EngineSnapshot& snapshot);

  QMenuBar* menu_bar_;
  const RigConfig& rig_;
  QPushButton* readiness_;
  PreflightPopup* preflight_;
  QLabel* mode_;
  StatusChip* cameras_;
  StatusChip* engine_;
  StatusChip* time_;
  StatusChip* transmitter_;
  StatusChip* pilot_;
  bool armed_ = false;
  bool holding_ = false;
  HoldButton* arm_;
  QPushButton* hold_;
  QPushButton* take_off_;
  QPushButton* land_;
  QPushButton* stop_;
};

}  // namespace helical
