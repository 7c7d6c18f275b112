#pragma once

#include <QWidget>

#include "engine/pipeline/snapshot.h"

class QLabel;
class QMenuBar;
class QPushButton;

namespace helical {

class StatusChip;

/// The bar that is always there: name, menus, readiness in one word, rates, flight time, Take off, Land,
/// STOP. Buttons only ask; what is shown is what the engine answers.
class TopBar : public QWidget {
  Q_OBJECT

 public:
  explicit TopBar(QWidget* parent = nullptr);

  QMenuBar* menuBar() const { return menu_bar_; }
  QPushButton* takeOffButton() const { return take_off_; }
  QPushButton* landButton() const { return land_; }
  QPushButton* stopButton() const { return stop_; }
  QString readiness() const;

  void show(const EngineSnapshot& snapshot);

 Q_SIGNALS:
  void takeOffRequested();
  void landRequested();
  void stopRequested();

 private:
  void buildButtons();
  void setReadiness(const EngineSnapshot& snapshot);

  QMenuBar* menu_bar_;
  QLabel* readiness_;
  QLabel* mode_;
  StatusChip* cameras_;
  StatusChip* engine_;
  StatusChip* time_;
  QPushButton* take_off_;
  QPushButton* land_;
  QPushButton* stop_;
};

}  // namespace helical
