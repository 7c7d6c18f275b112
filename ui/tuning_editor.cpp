#include "ui/tuning_editor.h"

#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <QWheelEvent>
#include <array>
#include <cmath>
#include <cstring>

#include "ui/theme.h"

namespace helical {
namespace {

struct KeyName {
  const char* key;
  const char* text;
};
constexpr std::array<KeyName, 18> kNames{{
    {"position_p", QT_TRANSLATE_NOOP("helical::TuningEditor", "Position P")},
    {"position_d", QT_TRANSLATE_NOOP("helical::TuningEditor", "Position D")},
    {"position_i", QT_TRANSLATE_NOOP("helical::TuningEditor", "Position I")},
    {"position_i_limit", QT_TRANSLATE_NOOP("helical::TuningEditor", "Position I limit")},
    {"position_error_limit", QT_TRANSLATE_NOOP("helical::TuningEditor", "Position error limit")},
    {"tilt", QT_TRANSLATE_NOOP("helical::TuningEditor", "Tilt")},
    {"phase", QT_TRANSLATE_NOOP("helical::TuningEditor", "Swash plate phase")},
    {"height_p", QT_TRANSLATE_NOOP("helical::TuningEditor", "Height P")},
    {"height_d", QT_TRANSLATE_NOOP("helical::TuningEditor", "Height D")},
    {"height_i", QT_TRANSLATE_NOOP("helical::TuningEditor", "Height I")},
    {"yaw_p", QT_TRANSLATE_NOOP("helical::TuningEditor", "Yaw P")},
    {"yaw_rate_limit", QT_TRANSLATE_NOOP("helical::TuningEditor", "Yaw rate limit")},
    {"yaw_d", QT_TRANSLATE_NOOP("helical::TuningEditor", "Yaw D")},
    {"yaw_i", QT_TRANSLATE_NOOP("helical::TuningEditor", "Yaw I")},
    {"trim_upper", QT_TRANSLATE_NOOP("helical::TuningEditor", "Trim upper rotor")},
    {"trim_lower", QT_TRANSLATE_NOOP("helical::TuningEditor", "Trim lower rotor")},
    {"trim_roll", QT_TRANSLATE_NOOP("helical::TuningEditor", "Trim roll")},
    {"trim_pitch", QT_TRANSLATE_NOOP("helical::TuningEditor", "Trim pitch")},
}};

QString nameOf(const ControllerKey& key) {
  for (const KeyName& name : kNames)
    if (std::strcmp(name.key, key.name) == 0) return TuningEditor::tr(name.text);
  return QString::fromLatin1(key.name);
}

/// Whoever scrolls past must not change a gain.
class Number final : public QDoubleSpinBox {
 protected:
  void wheelEvent(QWheelEvent* event) override { event->ignore(); }
};

}  // namespace

TuningEditor::TuningEditor(const ControllerOptions& from_rig, QWidget* parent)
    : QWidget(parent), from_rig_(from_rig), control_(from_rig), draft_(from_rig) {
  setAccessibleName(tr("Gains and trims"));
  auto* grid = new QGridLayout;
  grid->setVerticalSpacing(3);
  grid->setColumnStretch(0, 1);
  for (const ControllerKey& key : controllerKeys()) addRow(key, *grid);
  auto* buttons = new QHBoxLayout;
  const auto add = [&](const QString& text, const QString& tip) {
    auto* button = new QPushButton(text);
    button->setFont(theme::uiFont(8.4, QFont::Medium));
    button->setToolTip(tip);
    button->setAccessibleName(tr("Gains: %1").arg(text));
    button->setFocusPolicy(Qt::TabFocus);
    button->setAutoDefault(false);
    buttons->addWidget(button);
    return button;
  };
  defaults_ = add(tr("Rig's"), tr("The values of the rig file"));
  buttons->addStretch(1);
  revert_ = add(tr("Revert"), tr("Back to what is in force"));
  apply_ = add(tr("Apply"), tr("All changes at one control tick"));
  apply_->setObjectName(QStringLiteral("apply"));
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(12, 8, 12, 10);
  layout->addLayout(grid);
  layout->addStretch(1);
  layout->addLayout(buttons);
  connect(defaults_, &QPushButton::clicked, this, [this] {
    for (const ControllerKey& key : controllerKeys()) draft_.*key.value = from_rig_.*key.value;
    fill();
  });
  connect(revert_, &QPushButton::clicked, this, [this] {
    draft_ = control_;
    fill();
  });
  connect(apply_, &QPushButton::clicked, this, [this] { Q_EMIT applyRequested(draft_); });
  fill();
}

void TuningEditor::addRow(const ControllerKey& key, QGridLayout& grid) {
  auto* number = new Number;
  const double span = key.highest - key.lowest;
  const int decimals = span < 0.05 ? 4 : span < 0.7 ? 3 : 2;
  number->setDecimals(decimals);
  number->setRange(key.lowest, key.highest);
  number->setSingleStep(std::pow(10.0, -decimals) * (span < 0.05 ? 5.0 : 5.0));
  if (*key.unit != '\0') number->setSuffix(QStringLiteral(" ") + QString::fromLatin1(key.unit));
  number->setFont(theme::monoFont(8.4));
  number->setKeyboardTracking(false);
  number->setFocusPolicy(Qt::TabFocus);
  const QString name = nameOf(key);
  number->setAccessibleName(name);
  number->setToolTip(
      tr("Safe from %1 to %2; the rig has %3").arg(key.lowest).arg(key.highest).arg(from_rig_.*key.value));
  auto* label = new QLabel(name);
  label->setFont(theme::uiFont(8.6));
  label->setBuddy(number);
  const int row = grid.rowCount();
  grid.addWidget(label, row, 0);
  grid.addWidget(number, row, 1);
  connect(number, &QDoubleSpinBox::valueChanged, this, [this, &key](double value) {
    if (filling_) return;
    draft_.*key.value = value;
    mark();
  });
  numbers_.push_back(number);
  names_.push_back(label);
}

void TuningEditor::setControl(const ControllerOptions& control) {
  control_ = control;
  draft_ = control;
  fill();
}

QDoubleSpinBox* TuningEditor::number(const char* key) const {
  const auto keys = controllerKeys();
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (std::strcmp(keys[i].name, key) == 0) return numbers_[i];
  return nullptr;
}

void TuningEditor::fill() {
  filling_ = true;
  const auto keys = controllerKeys();
  for (std::size_t i = 0; i < keys.size(); ++i) numbers_[i]->setValue(draft_.*keys[i].value);
  filling_ = false;
  mark();
}

void TuningEditor::mark() {
  const auto keys = controllerKeys();
  bool any = false, other = false;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const bool changed = draft_.*keys[i].value != control_.*keys[i].value;
    any |= changed;
    other |= draft_.*keys[i].value != from_rig_.*keys[i].value;
    theme::setTextColor(*names_[i], changed ? theme::kCaution : theme::kMuted);
  }
  apply_->setEnabled(any);
  revert_->setEnabled(any);
  defaults_->setEnabled(other);
}

}  // namespace helical
