#include "ui/calibration_panel.h"

#include <QAbstractItemView>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>
#include <QVBoxLayout>
#include <QWheelEvent>
#include <algorithm>

#include "ui/calibration_row.h"
#include "ui/small_button.h"
#include "ui/theme.h"

namespace helical {
namespace {

QLabel* makeLabel(const QString& text) {
  auto* label = new QLabel(text);
  label->setFont(theme::uiFont(8.6));
  theme::setTextColor(*label, theme::kMuted);
  return label;
}

/// A list that the mouse wheel does not turn: whoever scrolls past must not throw cameras out of the control
/// set.
class MethodList final : public QComboBox {
 protected:
  void wheelEvent(QWheelEvent* event) override { event->ignore(); }
};

}  // namespace

CalibrationPanel::CalibrationPanel(const RigConfig& rig, const std::vector<std::string>& methods,
                                   QWidget* parent)
    : QWidget(parent), methods_(new MethodList) {
  setMinimumWidth(250);
  setAccessibleName(tr("Calibration"));
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(14, 8, 14, 8);
  layout->setSpacing(6);
  layout->addLayout(buildMethods(rig, methods));
  nobody_ = makeLabel(tr("No camera is calibrated in flight."));
  nobody_->setWordWrap(true);
  layout->addWidget(nobody_);
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    auto* row = new CalibrationRow(rig.cameras[i], static_cast<int>(i));
    row->setVisible(rig.cameras[i].learns());
    connect(row, &CalibrationRow::ordered, this, &CalibrationPanel::ordered);
    connect(row, &CalibrationRow::restartRequested, this, &CalibrationPanel::restartRequested);
    connect(row, &CalibrationRow::loadRequested, this, &CalibrationPanel::placeLoadRequested);
    connect(row, &CalibrationRow::saveRequested, this, &CalibrationPanel::placeSaveRequested);
    layout->addWidget(row);
    rows_.push_back(row);
  }
  layout->addLayout(buildFiles());
  showOnlyLearners();
  layout->addStretch(1);
}

QHBoxLayout* CalibrationPanel::buildMethods(const RigConfig& rig, const std::vector<std::string>& methods) {
  for (const std::string& method : methods) methods_->addItem(QString::fromStdString(method));
  methods_->setCurrentText(QString::fromStdString(rig.calibrator));
  methods_->setFont(theme::uiFont(8.6));
  methods_->setFocusPolicy(Qt::TabFocus);
  methods_->setAccessibleName(tr("Calibration method"));
  methods_->setToolTip(tr(
      "How cameras without a known place find theirs. Another method starts anew from the first guess: the "
      "camera leaves the control set until it is admitted again."));
  connect(methods_, &QComboBox::textActivated, this, &CalibrationPanel::methodChosen);
  auto* line = new QHBoxLayout;
  line->addWidget(makeLabel(tr("Method")));
  line->addWidget(methods_, 1);
  return line;
}

QHBoxLayout* CalibrationPanel::buildFiles() {
  load_ = smallButton(tr("Load\u2026"), tr("Load a calibration"),
                     tr("Every camera that a saved calibration names is believed to stand where it says"));
  save_ = smallButton(tr("Save\u2026"), tr("Save the calibration"),
                     tr("Where the cameras of the control set stand, with their uncertainty, to a file"));
  refine_ = smallButton(tr("Refine"), tr("Refine the places of all cameras"),
                        tr("Solves for all cameras together from what they saw in this flight, and for balls and "
                           "focal lengths, too, where the rig file has marker_sigma_m or focal_sigma"));
  connect(refine_, &QToolButton::clicked, this,
          [this] { Q_EMIT ordered(cameraId(0), CalibrationOrderKind::kRefine); });
  connect(load_, &QToolButton::clicked, this, &CalibrationPanel::loadRequested);
  connect(save_, &QToolButton::clicked, this, &CalibrationPanel::saveRequested);
  auto* line = new QHBoxLayout;
  line->addWidget(makeLabel(tr("All places")));
  line->addStretch(1);
  line->addWidget(refine_);
  line->addWidget(load_);
  line->addWidget(save_);
  return line;
}

void CalibrationPanel::addTick(const EngineSnapshot& tick) {
  for (CalibrationRow* row : rows_) row->addTick(tick);
}

const HeatMaps& CalibrationPanel::maps(int camera) const {
  return row(camera).maps();
}

void CalibrationPanel::setHypotheses(int camera, int total) {
  rows_[static_cast<std::size_t>(camera)]->setHypotheses(total);
}

void CalibrationPanel::setCommands(bool possible) {
  commands_ = possible;
  refine_->setEnabled(possible);
  load_->setEnabled(possible);
  save_->setEnabled(possible);
  for (CalibrationRow* row : rows_) row->setEnabled(possible);
  showOnlyLearners();
}

void CalibrationPanel::show(const EngineSnapshot& snapshot) {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const CameraSnapshot& state = snapshot.cameras[i];
    // A camera whose pose was given learns a new one once it is knocked; one that was placed by hand stays in
    // the list.
    if (state.calibration_method == nullptr && rows_[i]->isHidden()) continue;
    rows_[i]->setVisible(true);
    rows_[i]->show(snapshot);
    if (state.calibration_method != nullptr && !methods_->view()->isVisible() &&
        methods_->findText(QString::fromUtf8(state.calibration_method)) >= 0)
      methods_->setCurrentText(QString::fromUtf8(state.calibration_method));
  }
  showOnlyLearners();
}

void CalibrationPanel::showOnlyLearners() {
  const bool any =
      std::any_of(rows_.begin(), rows_.end(), [](const CalibrationRow* row) { return !row->isHidden(); });
  nobody_->setVisible(!any);
  methods_->setEnabled(any && commands_);
}

QString CalibrationPanel::state(int camera) const {
  return row(camera).isHidden() ? QString() : row(camera).state();
}

}  // namespace helical
