#include "ui/plan_editor.h"

#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QTableWidget>
#include <QVBoxLayout>

#include "engine/base/error.h"
#include "engine/geometry/rotation.h"
#include "ui/theme.h"

namespace helical {
namespace {

enum Column { kX, kY, kHeight, kYaw, kHold, kSpeed, kColumns };

double cellValue(const Waypoint& waypoint, int column) {
  switch (column) {
    case kX:
    case kY:
    case kHeight:
      return waypoint.position_above_pad[column];
    case kYaw:
      return toDegrees(waypoint.yaw);
    case kHold:
      return waypoint.hold_s;
    default:
      return waypoint.speed;
  }
}

void setCellValue(Waypoint& waypoint, int column, double value) {
  switch (column) {
    case kX:
    case kY:
    case kHeight:
      waypoint.position_above_pad[column] = value;
      return;
    case kYaw:
      waypoint.yaw = toRadians(value);
      return;
    case kHold:
      waypoint.hold_s = value;
      return;
    default:
      waypoint.speed = value;
  }
}

}  // namespace

PlanEditor::PlanEditor(QWidget* parent) : QWidget(parent), table_(new QTableWidget(0, kColumns)) {
  setAccessibleName(tr("Flight plan"));
  table_->setHorizontalHeaderLabels(
      {tr("x\nm"), tr("y\nm"), tr("height\nm"), tr("yaw\ndeg"), tr("hold\ns"), tr("speed\nm/s")});
  table_->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
  table_->horizontalHeader()->setMinimumSectionSize(30);
  table_->verticalHeader()->setDefaultSectionSize(22);
  table_->verticalHeader()->setMinimumWidth(22);
  table_->setFont(theme::monoFont(8.4));
  table_->horizontalHeader()->setFont(theme::uiFont(7.6));
  table_->setTabKeyNavigation(false);  // Tab must lead on, to STOP at last
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->setSelectionMode(QAbstractItemView::SingleSelection);
  table_->setAccessibleName(tr("Waypoints"));
  table_->setToolTip(
      tr("Places relative to the pad; the first is the take-off height. They can be dragged in "
         "the 3D scene, too."));
  table_->setMinimumHeight(112);
  connect(table_, &QTableWidget::cellChanged, this, &PlanEditor::takeCell);

  auto* edit = new QHBoxLayout;
  add_ = addButtonTo(*edit, tr("Add"), tr("One more waypoint behind the selected one"));
  remove_ = addButtonTo(*edit, tr("Remove"), tr("Take the selected waypoint out"));
  edit->addStretch(1);
  auto* grid = new QGridLayout;
  grid->setVerticalSpacing(4);
  grid->setColumnStretch(0, 1);
  climb_ = addNumber(*grid, tr("Climb"), tr("m/s"), 0.02, 1.0, 0.05, tr("Speed up to the first waypoint"));
  descent_ = addNumber(*grid, tr("Descent"), tr("m/s"), 0.02, 0.5, 0.02, tr("Speed down when it lands"));
  touchdown_ = addNumber(*grid, tr("Touchdown"), tr("m/s"), 0.02, 0.5, 0.02,
                         tr("Speed down within 12 cm of the ground; at most the descent speed"));
  land_at_ = addNumber(*grid, tr("Land after"), tr("s"), 0.0, 100'000.0, 5.0,
                       tr("Of flight time; 0: after the last waypoint's hold"));
  problem_ = new QLabel;
  problem_->setWordWrap(true);
  problem_->setFont(theme::uiFont(8.4));
  problem_->setAccessibleName(tr("What is wrong with the plan"));
  auto* buttons = new QHBoxLayout;
  buttons->addStretch(1);
  revert_ = addButtonTo(*buttons, tr("Revert"), tr("Back to the plan in force"));
  apply_ = addButtonTo(*buttons, tr("Apply"), tr("Fly this plan: all changes at one control tick"));
  apply_->setObjectName(QStringLiteral("apply"));

  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(10, 8, 10, 10);
  layout->setSpacing(7);
  layout->addWidget(table_, 1);
  layout->addLayout(edit);
  layout->addLayout(grid);
  layout->addWidget(problem_);
  layout->addLayout(buttons);
  connect(add_, &QPushButton::clicked, this, &PlanEditor::addWaypoint);
  connect(remove_, &QPushButton::clicked, this, &PlanEditor::removeWaypoint);
  connect(revert_, &QPushButton::clicked, this, [this] {
    edited_ = false;
    setPlan(plan_);
  });
  connect(apply_, &QPushButton::clicked, this, [this] {
    edited_ = false;
    Q_EMIT applyRequested(draft_);
    check();
  });
  fill();
}

QDoubleSpinBox* PlanEditor::addNumber(QGridLayout& grid, const QString& name, const QString& unit,
                                      double lowest, double highest, double step, const QString& tip) {
  auto* number = new QDoubleSpinBox;
  number->setRange(lowest, highest);
  number->setSingleStep(step);
  number->setDecimals(2);
  number->setSuffix(QStringLiteral(" ") + unit);
  number->setFont(theme::monoFont(8.6));
  number->setAccessibleName(name);
  number->setToolTip(tip);
  number->setKeyboardTracking(false);
  auto* label = new QLabel(name);
  label->setFont(theme::uiFont(8.6));
  label->setForegroundRole(QPalette::PlaceholderText);
  label->setBuddy(number);
  const int row = grid.rowCount();
  grid.addWidget(label, row, 0);
  grid.addWidget(number, row, 1);
  connect(number, &QDoubleSpinBox::valueChanged, this, &PlanEditor::takeNumbers);
  return number;
}

QPushButton* PlanEditor::addButtonTo(QHBoxLayout& line, const QString& text, const QString& tip) {
  auto* button = new QPushButton(text);
  button->setFont(theme::uiFont(8.4, QFont::Medium));
  button->setToolTip(tip);
  button->setAccessibleName(tr("Plan: %1").arg(text));
  button->setFocusPolicy(Qt::TabFocus);
  button->setAutoDefault(false);
  line.addWidget(button);
  return button;
}

void PlanEditor::setPlan(const FlightPlan& plan) {
  plan_ = plan;
  if (edited_) return check();
  draft_ = plan;
  fill();
  Q_EMIT draftChanged(draft_);
}

void PlanEditor::moveWaypoint(int index, const Eigen::Vector3d& position_above_pad) {
  if (index < 0 || index >= static_cast<int>(draft_.waypoints.size())) return;
  draft_.waypoints[static_cast<std::size_t>(index)].position_above_pad = position_above_pad;
  fill();
  table_->selectRow(index);
  changed();
}

void PlanEditor::fill() {
  filling_ = true;
  table_->setRowCount(static_cast<int>(draft_.waypoints.size()));
  for (int row = 0; row < table_->rowCount(); ++row)
    for (int column = 0; column < kColumns; ++column) {
      const double value = cellValue(draft_.waypoints[static_cast<std::size_t>(row)], column);
      auto* item =
          new QTableWidgetItem(QString::number(value, 'f', column == kYaw || column == kHold ? 0 : 2));
      item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
      table_->setItem(row, column, item);
    }
  climb_->setValue(draft_.climb_speed);
  descent_->setValue(draft_.descent_speed);
  touchdown_->setValue(draft_.touchdown_speed);
  land_at_->setValue(std::max(0.0, draft_.land_at_s));
  filling_ = false;
  check();
}

void PlanEditor::takeCell(int row, int column) {
  if (filling_) return;
  bool number = false;
  const double value = table_->item(row, column)->text().replace(',', '.').toDouble(&number);
  if (number) setCellValue(draft_.waypoints[static_cast<std::size_t>(row)], column, value);
  fill();  // what is no number goes back to what it was
  changed();
}

void PlanEditor::takeNumbers() {
  if (filling_) return;
  draft_.climb_speed = climb_->value();
  draft_.descent_speed = descent_->value();
  draft_.touchdown_speed = touchdown_->value();
  draft_.land_at_s = land_at_->value();
  changed();
}

void PlanEditor::addWaypoint() {
  const int at = table_->currentRow() < 0 ? table_->rowCount() - 1 : table_->currentRow();
  Waypoint next = draft_.waypoints[static_cast<std::size_t>(at)];
  next.position_above_pad.x() += 0.2;
  draft_.waypoints.insert(draft_.waypoints.begin() + at + 1, next);
  fill();
  table_->selectRow(at + 1);
  changed();
}

void PlanEditor::removeWaypoint() {
  const int at = table_->currentRow() < 0 ? table_->rowCount() - 1 : table_->currentRow();
  if (draft_.waypoints.size() < 2) return;
  draft_.waypoints.erase(draft_.waypoints.begin() + at);
  fill();
  changed();
}

void PlanEditor::changed() {
  edited_ = true;
  check();
  Q_EMIT draftChanged(draft_);
}

QString PlanEditor::problem() const {
  return problem_->text();
}

void PlanEditor::check() {
  QString problem;
  try {
    validate(draft_);
  } catch (const Error& error) {
    problem = QString::fromStdString(error.problem() + ": " + error.cure());
  }
  problem_->setText(problem);
  problem_->setVisible(!problem.isEmpty());
  apply_->setEnabled(edited_ && problem.isEmpty());
  revert_->setEnabled(edited_);
  remove_->setEnabled(draft_.waypoints.size() > 1);
}

}  // namespace helical
