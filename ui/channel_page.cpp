#include "ui/channel_page.h"

#include <QCheckBox>
#include <QCoreApplication>
#include <QDoubleSpinBox>
#include <QEvent>
#include <QFormLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QVBoxLayout>

#include "ui/catalogue.h"
#include "ui/theme.h"

namespace helical {
namespace {

constexpr double kFastestSlew = 1000.0;  // V/s: faster than any is no limit

}  // namespace

QString axisName(StickAxis axis) {
  const auto tr = [](const char* text) { return QCoreApplication::translate("ChannelPage", text); };
  switch (axis) {
    case StickAxis::kUpperRotor:
      return tr("Upper rotor");
    case StickAxis::kLowerRotor:
      return tr("Lower rotor");
    case StickAxis::kThrottle:
      return tr("Throttle");
    case StickAxis::kYaw:
      return tr("Yaw");
    case StickAxis::kRoll:
      return tr("Roll");
    case StickAxis::kPitch:
      return tr("Pitch");
  }
  return {};
}

ChannelPage::ChannelPage(StickAxis axis, int usual_output, QWidget* parent)
    : QWidget(parent), axis_(axis), output_(new QSpinBox), tried_(new QLabel) {
  output_->setValue(usual_output);
  output_->setAccessibleName(tr("Output of the device"));
  output_->setToolTip(tr("The terminal of the device that this channel's wire is on, counted from 0"));
  auto* form = new QFormLayout;
  form->setHorizontalSpacing(18);
  form->setVerticalSpacing(8);
  form->addRow(tr("Output of the device"), output_);
  const StickEnds ends = endsOf(axis);
  const MeasuredEnds usual = usualEnds(axis);
  volts_[0] = addVolts(*form, engineText(QString::fromLatin1(ends.low)), usual.low);
  volts_[1] = addVolts(*form, isThrottle(axis) ? tr("half") : tr("neutral"), usual.neutral);
  volts_[2] = addVolts(*form, engineText(QString::fromLatin1(ends.high)), usual.high);
  addLimits(*form);
  tried_->setFont(theme::monoFont(9));
  tried_->setAccessibleName(tr("On the output now"));
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addLayout(form);
  layout->addStretch(1);
  layout->addWidget(tried_);
  connect(output_, &QSpinBox::valueChanged, this, &ChannelPage::outputChosen);
}

QDoubleSpinBox* ChannelPage::addVolts(QFormLayout& form, const QString& name, double value) {
  auto* box = new QDoubleSpinBox;
  box->setRange(isThrottle(axis_) ? 0.0 : -kHighestVolts, kHighestVolts);
  box->setDecimals(2);
  box->setSingleStep(0.05);
  box->setValue(value);
  box->setKeyboardTracking(false);  // half a number must not reach the transmitter
  box->setSuffix(tr(" V"));
  box->setAccessibleName(tr("Volts, %1").arg(name));
  box->setToolTip(tr("It is on the output while you look at it or change it"));
  box->installEventFilter(this);
  form.addRow(name, box);
  connect(box, &QDoubleSpinBox::valueChanged, this, &ChannelPage::tried);
  return box;
}

void ChannelPage::addLimits(QFormLayout& form) {
  trim_ = new QDoubleSpinBox;
  trim_->setRange(-1.0, 1.0);
  trim_->setDecimals(2);
  trim_->setSingleStep(0.01);
  trim_->setSuffix(tr(" V"));
  trim_->setAccessibleName(tr("Trim"));
  trim_->setToolTip(tr("Moves neutral alone"));
  trim_->setEnabled(!isThrottle(axis_));
  slew_ = new QDoubleSpinBox;
  slew_->setRange(0.0, kFastestSlew);
  slew_->setDecimals(1);
  slew_->setSuffix(tr(" V/s"));
  slew_->setSpecialValueText(tr("any"));
  slew_->setAccessibleName(tr("Fastest change"));
  slew_->setToolTip(tr("The fastest change of this channel; 0: any"));
  reverse_ = new QCheckBox(tr("Reversed"));
  reverse_->setAccessibleName(tr("Reversed"));
  reverse_->setToolTip(tr("The other way round: exchanges the ends. A throttle is turned round in the transmitter."));
  reverse_->setEnabled(!isThrottle(axis_));
  form.addRow(tr("Trim"), trim_);
  form.addRow(tr("Fastest change"), slew_);
  form.addRow(QString(), reverse_);
  connect(reverse_, &QCheckBox::clicked, this, &ChannelPage::turnRound);
  for (QDoubleSpinBox* end : {volts_[0], volts_[2]})
    connect(end, &QDoubleSpinBox::valueChanged, this,
            [this] { reverse_->setChecked(lowEnd()->value() > highEnd()->value()); });
  connect(trim_, &QDoubleSpinBox::valueChanged, this,
          [this](double trim) { Q_EMIT tried(neutral()->value() + trim); });
}

void ChannelPage::turnRound() {
  const double low = lowEnd()->value(), high = highEnd()->value();
  const QSignalBlocker quiet_low(volts_[0]), quiet_high(volts_[2]);
  lowEnd()->setValue(high);
  highEnd()->setValue(low);
}

bool ChannelPage::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::FocusIn)
    for (const QDoubleSpinBox* box : volts_)
      if (watched == box) Q_EMIT tried(box->value());
  return QWidget::eventFilter(watched, event);
}

void ChannelPage::setOutputs(int count) {
  output_->setRange(0, count - 1);
}

OutputChannel ChannelPage::channel() const {
  const MeasuredEnds ends{lowEnd()->value(), neutral()->value(), highEnd()->value()};
  OutputChannel channel = channelOf(axis_, output_->value(), ends, slew_->value());
  channel.trim = trim_->value();
  return channel;
}

double ChannelPage::restVolts() const {
  return isThrottle(axis_) ? lowEnd()->value() : neutral()->value();
}

void ChannelPage::setTried(const QString& text) {
  tried_->setText(text);
}

}  // namespace helical
