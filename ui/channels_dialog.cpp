#include "ui/channels_dialog.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QRadioButton>
#include <QStackedWidget>
#include <QVBoxLayout>
#include <utility>

#include "engine/base/error.h"
#include "ui/channel_page.h"
#include "ui/direction_page.h"
#include "ui/format.h"
#include "ui/theme.h"

namespace helical {
namespace {

QLabel* paragraph(const QString& text) {
  auto* label = new QLabel(text);
  label->setWordWrap(true);
  return label;
}

QPushButton* stepButton(const QString& text) {
  auto* button = new QPushButton(text);
  button->setAccessibleName(text);
  button->setAutoDefault(false);
  return button;
}

}  // namespace

ChannelsDialog::ChannelsDialog(const TransmitterOptions& transmitter, Saver save, QWidget* parent)
    : QDialog(parent),
      transmitter_(transmitter),
      save_(std::move(save)),
      title_(new QLabel),
      problem_(new QLabel),
      pages_(new QStackedWidget),
      back_(stepButton(tr("Back"))),
      next_(stepButton(tr("Next"))) {
  setWindowTitle(tr("Channels of the transmitter"));
  setAccessibleName(windowTitle());
  title_->setFont(theme::uiFont(13, QFont::DemiBold));
  problem_->setWordWrap(true);
  problem_->setAccessibleName(tr("What is wrong"));
  theme::setTextColor(*problem_, theme::kCaution);
  next_->setObjectName(QStringLiteral("apply"));
  auto* buttons = new QHBoxLayout;
  auto* cancel = stepButton(tr("Cancel"));
  buttons->addWidget(cancel);
  buttons->addStretch(1);
  buttons->addWidget(back_);
  buttons->addWidget(next_);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(24, 20, 24, 18);
  layout->setSpacing(14);
  layout->addWidget(title_);
  layout->addWidget(pages_, 1);
  layout->addWidget(problem_);
  layout->addLayout(buttons);
  setMinimumSize(560, 440);
  addPage(tr("Before you begin"), buildIntroduction());
  if (!takesVoltages(transmitter_)) addPage(tr("Full deflections"), buildDeflections());
  directions_ = new DirectionPage;
  addPage(tr("Which way do the sticks go?"), directions_);
  addPage(tr("Done"), buildEnd());
  connect(cancel, &QPushButton::clicked, this, &QDialog::reject);
  connect(next_, &QPushButton::clicked, this, &ChannelsDialog::goOn);
  connect(back_, &QPushButton::clicked, this, &ChannelsDialog::goBack);
  connect(directions_, &DirectionPage::finished, this, [this] { goTo(pages_->currentIndex() + 1); });
  connect(directions_, &DirectionPage::failed, this, &ChannelsDialog::showProblem);
  enter(0);
  motors_off_->setFocus();
}

ChannelsDialog::~ChannelsDialog() = default;

void ChannelsDialog::addPage(const QString& title, QWidget* page) {
  titles_.push_back(title);
  pages_->addWidget(page);
}

QWidget* ChannelsDialog::buildIntroduction() {
  auto* page = new QWidget;
  auto* layout = new QVBoxLayout(page);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(12);
  layout->addWidget(
      paragraph(tr("The sticks will be moved, throttle included. Take the helicopter's motor battery out, or "
                   "disconnect the motors, "
                   "and keep only the radio and the servos powered.")));
  motors_off_ = new QCheckBox(tr("The motors cannot turn"));
  motors_off_->setAccessibleName(motors_off_->text());
  layout->addWidget(motors_off_);
  mixed_ = new QRadioButton(tr("One channel for throttle and one for yaw"));
  rotors_ = new QRadioButton(tr("One channel for each rotor"));
  mixed_->setChecked(true);
  for (QRadioButton* choice : {mixed_, rotors_}) {
    choice->setAccessibleName(choice->text());
    choice->setVisible(takesVoltages(transmitter_));
    layout->addWidget(choice);
  }
  layout->addStretch(1);
  connect(motors_off_, &QCheckBox::toggled, next_, &QPushButton::setEnabled);
  return page;
}

QDoubleSpinBox* ChannelsDialog::addNumber(QWidget& box, const QString& name, const QString& unit, double value,
                                          double highest) {
  auto* number = new QDoubleSpinBox;
  number->setRange(1.0, highest);
  number->setDecimals(0);
  number->setValue(value);
  number->setSuffix(unit);
  number->setAccessibleName(name);
  static_cast<QFormLayout*>(box.layout())->addRow(name, number);
  return number;
}

/// A radio takes set-points in known units: there is nothing to measure.
QWidget* ChannelsDialog::buildDeflections() {
  auto* page = new QWidget;
  auto* form = new QFormLayout(page);
  form->setContentsMargins(0, 0, 0, 0);
  form->setHorizontalSpacing(18);
  const FullDeflection usual;
  thrust_ = addNumber(*page, tr("Full throttle"), {}, usual.thrust, usual.thrust);
  yaw_ = addNumber(*page, tr("Full yaw"), tr(" deg/s"), usual.yaw_deg_s, 1000.0);
  tilt_ = addNumber(*page, tr("Full roll and pitch"), tr(" deg"), usual.tilt_deg, 60.0);
  return page;
}

QWidget* ChannelsDialog::buildEnd() {
  auto* page = new QWidget;
  auto* layout = new QVBoxLayout(page);
  layout->setContentsMargins(0, 0, 0, 0);
  end_ = paragraph({});
  layout->addWidget(end_);
  layout->addStretch(1);
  return page;
}

/// Between the introduction and the directions, anew for each choice of axes.
void ChannelsDialog::buildChannelPages() {
  const auto axes = axesOf(mixed_->isChecked());
  if (!channels_.empty() && channels_.front()->axis() == axes.front()) return;
  for (ChannelPage* page : channels_) {
    pages_->removeWidget(page);
    titles_.erase(titles_.begin() + 1);
    page->deleteLater();
  }
  channels_.clear();
  for (const StickAxis axis : axes) {
    const int number = static_cast<int>(channels_.size());
    auto* page = new ChannelPage(axis, number);
    channels_.push_back(page);
    pages_->insertWidget(number + 1, page);
    titles_.insert(titles_.begin() + number + 1, axisName(axis));
    connectPage(*page);
  }
}

void ChannelsDialog::connectPage(ChannelPage& page) {
  const auto try_out = [this, &page](double volts) {
    attempt([&] {
      if (!probe_ || this->page() != &page) return;
      probe_->put(volts);
      page.setTried(tr("on output %1 now: %2 V").arg(page.output()->value()).arg(signedNumber(volts, 2)));
    });
  };
  connect(&page, &ChannelPage::tried, this, try_out);
  connect(&page, &ChannelPage::outputChosen, this, [this, &page, try_out](int output) {
    attempt([&] {
      if (!probe_ || this->page() != &page) return;
      probe_->choose(output, page.axis());
      try_out(page.restVolts());
    });
  });
}

ChannelPage* ChannelsDialog::page() const {
  return qobject_cast<ChannelPage*>(pages_->currentWidget());
}

void ChannelsDialog::attempt(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    showProblem(QString::fromStdString(error.problem() + ": " + error.cure()));
  }
}

void ChannelsDialog::showProblem(const QString& text) {
  problem_->setText(text);
}

QString ChannelsDialog::problem() const {
  return problem_->text();
}

void ChannelsDialog::goTo(int index) {
  showProblem({});
  leave();
  attempt([&] { enter(index); });
}

void ChannelsDialog::leave() {
  if (page() != nullptr && probe_) attempt([this] { probe_->put(page()->restVolts()); });
  directions_->end();
}

/// Where a page needs the device, that comes first: without it the dialog stays where it is.
void ChannelsDialog::enter(int index) {
  QWidget* target = pages_->widget(index);
  auto* channel = qobject_cast<ChannelPage*>(target);
  if (channel != nullptr && !probe_) probe_ = std::make_unique<OutputProbe>(transmitter_.device);
  if (target == directions_) {
    probe_.reset();  // the output process owns the device from here on
    directions_->begin(transmitter_);
  }
  pages_->setCurrentIndex(index);
  title_->setText(titles_[static_cast<std::size_t>(index)]);
  showButtons();
  if (channel != nullptr) {
    channel->setOutputs(probe_->count());
    probe_->choose(channel->output()->value(), channel->axis());
    channel->lowEnd()->setFocus();
    Q_EMIT channel->tried(channel->lowEnd()->value());
  }
  end_->setText(directions_->done()
                    ? tr("Every stick has been seen to go the right way. Save, and the rig can arm.")
                    : tr("Saved like this the rig does not arm: nobody has seen which way the sticks go."));
}

void ChannelsDialog::showButtons() {
  const int index = pages_->currentIndex();
  const bool last = index + 1 == pages_->count();
  back_->setEnabled(index > 0);
  next_->setText(last ? tr("Save") : pages_->currentWidget() == directions_ ? tr("Skip") : tr("Next"));
  next_->setAccessibleName(next_->text());
  next_->setEnabled(index > 0 || motors_off_->isChecked());
}

OutputChannels ChannelsDialog::measured() const {
  if (!takesVoltages(transmitter_)) return channelsOf({thrust_->value(), yaw_->value(), tilt_->value()});
  OutputChannels channels;
  for (const ChannelPage* page : channels_)
    channels.all[static_cast<std::size_t>(channels.count++)] = page->channel();
  return channels;
}

void ChannelsDialog::goOn() {
  const int index = pages_->currentIndex();
  if (index + 1 == pages_->count()) return save();
  if (index == 0 && takesVoltages(transmitter_)) buildChannelPages();
  if (pages_->widget(index + 1) != directions_) return goTo(index + 1);
  attempt([&] {
    TransmitterOptions candidate = transmitter_;
    candidate.channels = measured();
    validate(candidate);
    transmitter_ = candidate;
    goTo(index + 1);
  });
}

void ChannelsDialog::goBack() {
  goTo(std::max(0, pages_->currentIndex() - 1));
}

void ChannelsDialog::save() {
  attempt([this] {
    save_(directions_->channels(), directions_->done());
    accept();
  });
}

}  // namespace helical
