#include "ui/colour_editor.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <QSpinBox>
#include <QVBoxLayout>

#include "ui/theme.h"

namespace helical {
namespace {

constexpr std::array<int ColourRange::*, 6> kValues{
    &ColourRange::hue_low,         &ColourRange::hue_high,  &ColourRange::saturation_low,
    &ColourRange::saturation_high, &ColourRange::value_low, &ColourRange::value_high};

}  // namespace

ColourEditor::ColourEditor(QWidget* parent) : QDialog(parent, Qt::Tool), hint_(new QLabel) {
  setWindowTitle(tr("Colour of the markers"));
  setAccessibleName(windowTitle());
  hint_->setWordWrap(true);
  hint_->setFont(theme::uiFont(8.8));
  auto* grid = new QGridLayout;
  grid->setHorizontalSpacing(10);
  const std::array<QString, 6> names{tr("Hue from"),      tr("Hue to"),     tr("Saturation from"),
                                     tr("Saturation to"), tr("Value from"), tr("Value to")};
  for (int i = 0; i < 6; ++i) buildSlider(i, names[static_cast<std::size_t>(i)], i < 2 ? 179 : 255, *grid);
  apply_ = new QPushButton(tr("Apply"));
  apply_->setToolTip(tr("All cameras look for this colour from now on"));
  undo_ = new QPushButton(tr("Undo"));
  undo_->setToolTip(tr("Back to what was applied before"));
  for (QPushButton* button : {apply_, undo_}) {
    button->setAutoDefault(false);
    button->setAccessibleName(button->text());
  }
  connect(apply_, &QPushButton::clicked, this, &ColourEditor::apply);
  connect(undo_, &QPushButton::clicked, this, &ColourEditor::undo);
  auto* buttons = new QHBoxLayout;
  buttons->addStretch(1);
  buttons->addWidget(undo_);
  buttons->addWidget(apply_);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(18, 14, 18, 14);
  layout->setSpacing(12);
  layout->addWidget(hint_);
  layout->addLayout(grid);
  layout->addLayout(buttons);
  setMinimumWidth(360);
}

void ColourEditor::buildSlider(int index, const QString& name, int highest, QGridLayout& grid) {
  auto* slider = new QSlider(Qt::Horizontal);
  auto* number = new QSpinBox;
  slider->setRange(0, highest);
  number->setRange(0, highest);
  slider->setAccessibleName(name);
  number->setAccessibleName(name);
  const QString tip = index < 2 ? tr("Red is 0, green 60, blue 120; from above to wraps through red")
                                : tr("0 is grey or black, 255 vivid or bright");
  slider->setToolTip(tip);
  number->setToolTip(tip);
  number->setFont(theme::monoFont(9));
  auto* label = new QLabel(name);
  label->setBuddy(number);
  grid.addWidget(label, index, 0);
  grid.addWidget(slider, index, 1);
  grid.addWidget(number, index, 2);
  const auto take = [this, index](int value) {
    ColourRange changed = range_;
    changed.*kValues[static_cast<std::size_t>(index)] = value;
    setRange(changed);
  };
  connect(slider, &QSlider::valueChanged, this, take);
  connect(number, &QSpinBox::valueChanged, this, take);
  sliders_[static_cast<std::size_t>(index)] = slider;
  numbers_[static_cast<std::size_t>(index)] = number;
}

void ColourEditor::begin(const ColourRange& applied) {
  applied_ = {applied};
  hint_->setText(tr("Click a ball in a camera's picture. What would be found is tinted."));
  setRange(applied);
}

void ColourEditor::propose(const ColourRange& range) {
  hint_->setText(tr("The range of the ball you clicked. Apply it, or change it first."));
  setRange(range);
}

void ColourEditor::tellNothingPicked() {
  hint_->setText(tr("There is nothing coloured. Click the middle of a ball; zoom in with the wheel."));
}

void ColourEditor::setRange(const ColourRange& range) {
  range_ = range;
  for (std::size_t i = 0; i < kValues.size(); ++i) {
    const QSignalBlocker slider(sliders_[i]), number(numbers_[i]);
    sliders_[i]->setValue(range.*kValues[i]);
    numbers_[i]->setValue(range.*kValues[i]);
  }
  enableButtons();
  Q_EMIT rangeChanged(range_);
}

void ColourEditor::apply() {
  applied_.push_back(range_);
  Q_EMIT applyRequested(range_);
  enableButtons();
}

void ColourEditor::undo() {
  if (applied_.size() < 2) return;
  applied_.pop_back();
  setRange(applied_.back());
  Q_EMIT applyRequested(range_);
}

void ColourEditor::enableButtons() {
  const bool sane = range_.saturation_low <= range_.saturation_high && range_.value_low <= range_.value_high;
  apply_->setEnabled(sane && !(range_ == applied_.back()));
  undo_->setEnabled(applied_.size() > 1);
}

void ColourEditor::hideEvent(QHideEvent* event) {
  QDialog::hideEvent(event);
  Q_EMIT closed();
}

}  // namespace helical
