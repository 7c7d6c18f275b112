#include "ui/calibration_row.h"

#include <QGridLayout>
#include <QLabel>
#include <QStringList>
#include <QToolButton>
#include <cmath>

#include "engine/geometry/camera_perturbation.h"
#include "engine/geometry/rotation.h"
#include "ui/format.h"
#include "ui/heat_maps.h"
#include "ui/small_button.h"
#include "ui/status_words.h"
#include "ui/theme.h"

namespace helical {
namespace {

constexpr std::size_t kSigma = 0;
constexpr std::size_t kBound = 1;
constexpr std::size_t kError = 2;

QLabel* makeLabel(const QString& text, const QFont& font, const QColor& color, Qt::Alignment alignment) {
  auto* label = new QLabel(text);
  label->setFont(font);
  label->setAlignment(alignment | Qt::AlignVCenter);
  theme::setTextColor(*label, color);
  return label;
}

QLabel* makeValue(const QColor& color) {
  return makeLabel(kNoValue, theme::monoFont(8.8, QFont::Medium), color, Qt::AlignRight);
}

QString magnitude(double value) {
  if (!std::isfinite(value)) return kNoValue;
  return plainNumber(value, value < 0.1 ? 3 : value < 10.0 ? 2 : value < 100.0 ? 1 : 0);
}

QToolButton* wideButton(const QString& text, const QString& name, const QString& tip) {
  QToolButton* button = smallButton(text, name, tip);
  button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  return button;
}

}  // namespace

CalibrationRow::CalibrationRow(const CameraConfig& config, int camera, QWidget* parent)
    : QWidget(parent),
      camera_(camera),
      state_(makeLabel({}, theme::uiFont(8.6, QFont::DemiBold), theme::kText, Qt::AlignRight)),
      position_{makeValue(theme::kText), makeValue(theme::kMuted), makeValue(theme::kMuted)},
      orientation_{makeValue(theme::kText), makeValue(theme::kMuted), makeValue(theme::kMuted)},
      effective_name_(makeLabel(tr("Effective"), theme::uiFont(8.6), theme::kMuted, Qt::AlignLeft)),
      effective_(makeValue(theme::kText)),
      labelling_name_(makeLabel(tr("Labelling"), theme::uiFont(8.6), theme::kMuted, Qt::AlignLeft)),
      labelling_(makeValue(theme::kText)) {
  const QString name = QString::fromStdString(config.name);
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 4, 0, 2);
  grid->setHorizontalSpacing(8);
  grid->setVerticalSpacing(3);
  grid->setColumnStretch(0, 1);
  grid->addWidget(makeLabel(name, theme::capsFont(7.2), theme::cameraColor(camera), Qt::AlignLeft), 0, 0);
  grid->addWidget(state_, 0, 1, 1, 4);
  grid->addWidget(buildButtons(config, name), 1, 0, 1, 5);
  const std::array<QString, 3> heads{tr("sigma"), tr("bound"), tr("error")};
  for (std::size_t i = 0; i < heads.size(); ++i) {
    grid->addWidget(makeLabel(heads[i], theme::uiFont(7.6), theme::kFaint, Qt::AlignRight), 2,
                    static_cast<int>(i) + 1);
    grid->setColumnMinimumWidth(static_cast<int>(i) + 1, 40);
    position_[i]->setAccessibleName(tr("Position, %1").arg(heads[i]));
    orientation_[i]->setAccessibleName(tr("Orientation, %1").arg(heads[i]));
  }
  const auto add = [&](int line, const QString& text, const std::array<QLabel*, 3>& values,
                       const QString& unit) {
    grid->addWidget(makeLabel(text, theme::uiFont(8.6), theme::kMuted, Qt::AlignLeft), line, 0);
    for (std::size_t i = 0; i < values.size(); ++i) grid->addWidget(values[i], line, static_cast<int>(i) + 1);
    grid->addWidget(makeLabel(unit, theme::uiFont(7.8), theme::kFaint, Qt::AlignLeft), line, 4);
  };
  add(3, tr("Position"), position_, tr("mm"));
  add(4, tr("Orientation"), orientation_, tr("deg"));
  grid->addWidget(effective_name_, 5, 0);
  grid->addWidget(effective_, 5, 1, 1, 3);
  effective_->setToolTip(tr("Effective sample size of the particles, of all"));
  maps_ = new HeatMaps(name, QSize(config.model.width(), config.model.height()));
  grid->addWidget(labelling_name_, 6, 0);
  grid->addWidget(labelling_, 6, 1, 1, 4);
  labelling_->setAccessibleName(tr("Labelling"));
  grid->addWidget(maps_, 7, 0, 1, 5);
}

QWidget* CalibrationRow::buildButtons(const CameraConfig& config, const QString& name) {
  makeButtons(name);
  connectButtons();
  rig_->setVisible(config.camera_from_world.has_value() && !config.learns());
  auto* box = new QWidget;
  auto* grid = new QGridLayout(box);
  grid->setContentsMargins(0, 2, 0, 2);
  grid->setSpacing(4);
  int column = 0;
  for (QToolButton* button : {accept_, freeze_, restart_}) grid->addWidget(button, 0, column++);
  column = 0;
  for (QToolButton* button : {load_, save_, rig_}) grid->addWidget(button, 1, column++);
  for (int i = 0; i < 3; ++i) grid->setColumnStretch(i, 1);
  showButtons({});
  return box;
}

void CalibrationRow::makeButtons(const QString& name) {
  accept_ =
      wideButton(tr("Accept"), tr("Accept what %1 has learnt").arg(name),
                 tr("%1 helps the pose from now on, with what it knows, before the rule lets it").arg(name));
  freeze_ = wideButton(tr("Freeze"), {}, {});
  restart_ = wideButton(tr("Restart"), tr("Restart the calibration of %1").arg(name),
                        tr("Forget what %1 has learnt and begin again from its first guess").arg(name));
  load_ = wideButton(tr("Load\u2026"), tr("Load the place of %1").arg(name),
                     tr("Believe that %1 stands where a saved calibration says").arg(name));
  save_ = wideButton(tr("Save\u2026"), tr("Save the place of %1").arg(name),
                     tr("Where %1 stands, with its uncertainty, to a file").arg(name));
  rig_ = wideButton(tr("Rig file"), tr("Put %1 where the rig file says").arg(name),
                    tr("Believe that %1 stands where the rig file says").arg(name));
}

void CalibrationRow::connectButtons() {
  connect(accept_, &QToolButton::clicked, this,
          [this] { Q_EMIT ordered(cameraId(camera_), CalibrationOrderKind::kAccept); });
  connect(freeze_, &QToolButton::clicked, this, [this] {
    Q_EMIT ordered(cameraId(camera_),
                   frozen_ ? CalibrationOrderKind::kResume : CalibrationOrderKind::kFreeze);
  });
  connect(restart_, &QToolButton::clicked, this, [this] {
    maps_->clear();
    Q_EMIT restartRequested(cameraId(camera_));
  });
  connect(rig_, &QToolButton::clicked, this,
          [this] { Q_EMIT ordered(cameraId(camera_), CalibrationOrderKind::kTrustRig); });
  connect(load_, &QToolButton::clicked, this, [this] { Q_EMIT loadRequested(cameraId(camera_)); });
  connect(save_, &QToolButton::clicked, this, [this] { Q_EMIT saveRequested(cameraId(camera_)); });
}

void CalibrationRow::addTick(const EngineSnapshot& tick) {
  maps_->add(tick.cameras[static_cast<std::size_t>(camera_)].track, tick.marker_count);
}

void CalibrationRow::show(const EngineSnapshot& snapshot) {
  const CameraSnapshot& state = snapshot.cameras[static_cast<std::size_t>(camera_)];
  const StatusWord word = calibrationWord(snapshot, camera_);
  state_->setText(state.frozen ? tr("%1, frozen").arg(word.text) : word.text);
  theme::setTextColor(*state_, word.color);
  showNumbers(state);
  showLabelling(state.labellings);
  showButtons(state);
  maps_->update();
}

void CalibrationRow::showNumbers(const CameraSnapshot& state) {
  const Matrix6d& covariance = state.estimate.covariance;
  const double position = covariance.bottomRightCorner<3, 3>().trace();
  const bool spread = position > 0.0;
  const double turn = covariance.topLeftCorner<3, 3>().trace();
  position_[kSigma]->setText(spread ? magnitude(1e3 * std::sqrt(position)) : kNoValue);
  orientation_[kSigma]->setText(spread ? magnitude(toDegrees(std::sqrt(turn))) : kNoValue);
  const auto& bound = state.calibration_bound;
  position_[kBound]->setText(bound ? magnitude(1e3 * bound->position_m) : kNoValue);
  orientation_[kBound]->setText(bound ? magnitude(toDegrees(bound->orientation_rad)) : kNoValue);
  if (state.has_truth) {
    const Vector6d error = cameraPerturbation(state.true_camera_from_world, state.estimate.camera_from_world);
    position_[kError]->setText(magnitude(1e3 * error.tail<3>().norm()));
    orientation_[kError]->setText(magnitude(toDegrees(error.head<3>().norm())));
  }
  // Methods without particles have none to count.
  for (QLabel* label : {effective_name_, effective_}) label->setVisible(hypotheses_ > 0);
  effective_->setText(
      state.effective_sample_size > 0.0
          ? QStringLiteral("%1/%2").arg(plainNumber(state.effective_sample_size, 0)).arg(hypotheses_)
          : kNoValue);
}

void CalibrationRow::showLabelling(const TriedLabellings& tried) {
  for (QLabel* label : {labelling_name_, labelling_}) label->setVisible(tried.count > 0);
  QString taken;
  QStringList all{tr("The balls in the image, from left to right, as it takes them."),
                  tried.by_misfit
                      ? tr("Labellings weighed up, with their misfit in standard deviations:")
                      : tr("Labellings weighed up, with their distance De from the first guess:")};
  for (int i = 0; i < tried.count; ++i) {
    const TriedLabelling& labelling = tried.all[static_cast<std::size_t>(i)];
    QStringList balls;
    for (int m = 0; m < labelling.count; ++m)
      balls << QString::number(labelling.marker[static_cast<std::size_t>(m)] + 1);
    const QString name = balls.join(QLatin1Char('-'));
    if (i == 0) taken = name;
    const QString value = plainNumber(double(labelling.value), 3);
    all << (tried.by_misfit ? QStringLiteral("%1   %2").arg(name, value) : tr("%1   %2 m").arg(name, value));
  }
  labelling_->setText(taken);
  labelling_->setToolTip(all.join(QLatin1Char('\n')));
}

void CalibrationRow::showButtons(const CameraSnapshot& state) {
  save_->setEnabled(state.estimate.status == CameraStatus::kCalibrated);
  accept_->setEnabled(state.estimate.status != CameraStatus::kCalibrated);
  if (frozen_ == state.frozen && !freeze_->accessibleName().isEmpty()) return;
  frozen_ = state.frozen;
  freeze_->setText(frozen_ ? tr("Resume") : tr("Freeze"));
  freeze_->setAccessibleName(frozen_ ? tr("Resume learning") : tr("Freeze what is known"));
  freeze_->setToolTip(frozen_ ? tr("Learn on from what it knows")
                              : tr("Learn no more; a knock takes it out of the control set all the same"));
}

QString CalibrationRow::labelling() const {
  return labelling_->isHidden() ? QString() : labelling_->text();
}

QString CalibrationRow::state() const {
  return state_->text();
}

}  // namespace helical
