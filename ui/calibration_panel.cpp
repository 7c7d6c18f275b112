#include "ui/calibration_panel.h"

#include <QAbstractItemView>
#include <QComboBox>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>
#include <QVBoxLayout>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "engine/geometry/camera_perturbation.h"
#include "ui/format.h"
#include "ui/heat_maps.h"
#include "ui/status_words.h"
#include "ui/theme.h"

namespace helical {
namespace {

QLabel* makeLabel(const QString& text, const QFont& font, const QColor& color, Qt::Alignment alignment) {
  auto* label = new QLabel(text);
  label->setFont(font);
  label->setAlignment(alignment | Qt::AlignVCenter);
  QPalette palette = label->palette();
  palette.setColor(QPalette::WindowText, color);
  label->setPalette(palette);
  return label;
}

void setColor(QLabel& label, const QColor& color) {
  QPalette palette = label.palette();
  if (palette.color(QPalette::WindowText) == color) return;
  palette.setColor(QPalette::WindowText, color);
  label.setPalette(palette);
}

QString magnitude(double value) {
  if (!std::isfinite(value)) return kNoValue;
  return plainNumber(value, value < 10.0 ? 2 : value < 100.0 ? 1 : 0);
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
  line->addWidget(makeLabel(tr("Method"), theme::uiFont(8.6), theme::kMuted, Qt::AlignLeft));
  line->addWidget(methods_, 1);
  layout->addLayout(line);
  nobody_ =
      makeLabel(tr("No camera is calibrated in flight."), theme::uiFont(8.6), theme::kMuted, Qt::AlignLeft);
  nobody_->setWordWrap(true);
  layout->addWidget(nobody_);
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    QWidget* box = buildRow(rig.cameras[i], static_cast<int>(i));
    box->setVisible(rig.cameras[i].learns());
    layout->addWidget(box);
  }
  showOnlyLearners();
  layout->addStretch(1);
}

QWidget* CalibrationPanel::buildRow(const CameraConfig& config, int camera) {
  Row row;
  row.camera = camera;
  const QString name = QString::fromStdString(config.name);
  const auto value = [](const QColor& color) {
    return makeLabel(kNoValue, theme::monoFont(8.8, QFont::Medium), color, Qt::AlignRight);
  };
  const auto head = [](const QString& text) {
    return makeLabel(text, theme::uiFont(7.6), theme::kFaint, Qt::AlignRight);
  };
  row.state = makeLabel({}, theme::uiFont(8.6, QFont::DemiBold), theme::kText, Qt::AlignRight);
  row.position_sigma = value(theme::kText);
  row.position_error = value(theme::kMuted);
  row.orientation_sigma = value(theme::kText);
  row.orientation_error = value(theme::kMuted);
  row.effective = value(theme::kText);
  auto* restart = new QToolButton;
  restart->setObjectName(QStringLiteral("small"));
  restart->setText(tr("Restart"));
  restart->setFont(theme::uiFont(8, QFont::Medium));
  restart->setFixedHeight(19);
  restart->setFocusPolicy(Qt::TabFocus);
  restart->setAccessibleName(tr("Restart the calibration of %1").arg(name));
  restart->setToolTip(tr("Forget what %1 has learnt and begin again from its first guess").arg(name));
  connect(restart, &QToolButton::clicked, this,
          [this, camera] { Q_EMIT restartRequested(cameraId(camera)); });

  auto* box = new QWidget;
  row.box = box;
  auto* grid = new QGridLayout(box);
  grid->setContentsMargins(0, 4, 0, 2);
  grid->setHorizontalSpacing(8);
  grid->setVerticalSpacing(3);
  grid->setColumnStretch(0, 1);
  grid->addWidget(makeLabel(name, theme::capsFont(7.2), theme::cameraColor(camera), Qt::AlignLeft), 0, 0);
  grid->addWidget(row.state, 0, 1, 1, 2);
  grid->addWidget(restart, 0, 3);
  grid->addWidget(head(tr("sigma")), 1, 1);
  grid->addWidget(head(tr("error")), 1, 2);
  const auto add = [&](int line, const QString& text, QLabel* first, QLabel* second, const QString& unit) {
    grid->addWidget(makeLabel(text, theme::uiFont(8.6), theme::kMuted, Qt::AlignLeft), line, 0);
    grid->addWidget(first, line, 1, 1, second ? 1 : 2);
    if (second) grid->addWidget(second, line, 2);
    grid->addWidget(makeLabel(unit, theme::uiFont(7.8), theme::kFaint, Qt::AlignLeft), line, 3);
  };
  add(2, tr("Position"), row.position_sigma, row.position_error, tr("mm"));
  add(3, tr("Orientation"), row.orientation_sigma, row.orientation_error, tr("deg"));
  add(4, tr("Effective"), row.effective, nullptr, {});
  row.effective->setToolTip(tr("Effective sample size of the particles, of all"));
  row.maps = new HeatMaps(name, QSize(config.model.width(), config.model.height()));
  grid->addWidget(row.maps, 5, 0, 1, 4);
  connect(restart, &QToolButton::clicked, row.maps, &HeatMaps::clear);
  for (int column : {1, 2}) grid->setColumnMinimumWidth(column, 46);
  rows_.push_back(row);
  return box;
}

void CalibrationPanel::addTick(const EngineSnapshot& tick) {
  for (const Row& row : rows_)
    row.maps->add(tick.cameras[static_cast<std::size_t>(row.camera)].track, tick.marker_count);
}

void CalibrationPanel::setHypotheses(int camera, int total) {
  for (Row& row : rows_)
    if (row.camera == camera) row.hypotheses = total;
}

void CalibrationPanel::showRow(const Row& row, const EngineSnapshot& snapshot) {
  const CameraSnapshot& state = snapshot.cameras[static_cast<std::size_t>(row.camera)];
  const StatusWord word = calibrationWord(snapshot, row.camera);
  row.state->setText(word.text);
  setColor(*row.state, word.color);
  const Matrix6d& covariance = state.estimate.covariance;
  const double position = covariance.bottomRightCorner<3, 3>().trace();
  const bool spread = position > 0.0;
  row.position_sigma->setText(spread ? magnitude(1e3 * std::sqrt(position)) : kNoValue);
  row.orientation_sigma->setText(
      spread ? magnitude(toDegrees(std::sqrt(covariance.topLeftCorner<3, 3>().trace()))) : kNoValue);
  if (state.has_truth) {
    const Vector6d error = cameraPerturbation(state.true_camera_from_world, state.estimate.camera_from_world);
    row.position_error->setText(magnitude(1e3 * error.tail<3>().norm()));
    row.orientation_error->setText(magnitude(toDegrees(error.head<3>().norm())));
  }
  row.maps->update();
  row.effective->setText(
      state.effective_sample_size > 0.0 && row.hypotheses > 0
          ? QStringLiteral("%1/%2").arg(plainNumber(state.effective_sample_size, 0)).arg(row.hypotheses)
          : kNoValue);
}

void CalibrationPanel::show(const EngineSnapshot& snapshot) {
  for (const Row& row : rows_) {
    const CameraSnapshot& state = snapshot.cameras[static_cast<std::size_t>(row.camera)];
    if (state.calibration_method == nullptr) continue;
    // A camera whose pose was given learns a new one once it is knocked.
    row.box->show();
    showRow(row, snapshot);
    if (!methods_->view()->isVisible()) methods_->setCurrentText(QString::fromUtf8(state.calibration_method));
  }
  showOnlyLearners();
}

void CalibrationPanel::showOnlyLearners() {
  const bool any =
      std::any_of(rows_.begin(), rows_.end(), [](const Row& row) { return !row.box->isHidden(); });
  nobody_->setVisible(!any);
  methods_->setEnabled(any);
}

QString CalibrationPanel::state(int camera) const {
  for (const Row& row : rows_)
    if (row.camera == camera && !row.box->isHidden()) return row.state->text();
  return {};
}

}  // namespace helical
