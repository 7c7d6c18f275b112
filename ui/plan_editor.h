#pragma once

#include <QWidget>

#include "engine/flight/flight_plan.h"

class QDoubleSpinBox;
class QGridLayout;
class QHBoxLayout;
class QLabel;
class QPushButton;
class QTableWidget;

namespace helical {

/// The flight plan as a draft: waypoints, speeds, when to land. Nothing is flown before Apply, which hands
/// over all of it at once; what is wrong with the draft is said at once and keeps Apply off. Waypoints can be
/// moved from outside, too, by dragging them in the 3D scene.
class PlanEditor : public QWidget {
  Q_OBJECT

 public:
  explicit PlanEditor(QWidget* parent = nullptr);

  /// The plan in force: the draft begins from it, unless somebody is editing.
  void setPlan(const FlightPlan& plan);
  const FlightPlan& draft() const { return draft_; }
  bool edited() const { return edited_; }
  /// Moves a waypoint of the draft.
  void moveWaypoint(int index, const Eigen::Vector3d& position_above_pad);

  QPushButton* applyButton() const { return apply_; }
  QPushButton* revertButton() const { return revert_; }
  QPushButton* addButton() const { return add_; }
  QPushButton* removeButton() const { return remove_; }
  QTableWidget& table() const { return *table_; }
  QString problem() const;

 Q_SIGNALS:
  void draftChanged(const helical::FlightPlan& draft);
  void applyRequested(const helical::FlightPlan& plan);

 private:
  QDoubleSpinBox* addNumber(QGridLayout& grid, const QString& name, const QString& unit, double lowest,
                            double highest, double step, const QString& tip);
  QPushButton* addButtonTo(QHBoxLayout& line, const QString& text, const QString& tip);
  void fill();
  void takeCell(int row, int column);
  void takeNumbers();
  void addWaypoint();
  void removeWaypoint();
  void changed();
  void check();

  FlightPlan plan_;
  FlightPlan draft_;
  bool edited_ = false;
  bool filling_ = false;
  QTableWidget* table_;
  QDoubleSpinBox* climb_;
  QDoubleSpinBox* descent_;
  QDoubleSpinBox* touchdown_;
  QDoubleSpinBox* land_at_;
  QLabel* problem_;
  QPushButton* add_;
  QPushButton* remove_;
  QPushButton* revert_;
  QPushButton* apply_;
};

}  // namespace helical
