#include "ui/direction_page.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "engine/base/error.h"
#include "engine/transmitter/direction_check.h"
#include "ui/catalogue.h"
#include "ui/theme.h"

namespace helical {
namespace {

constexpr int kRenewalMs = 20;

QPushButton* answerButton(const QString& text) {
  auto* button = new QPushButton(text);
  button->setAccessibleName(text);
  button->setAutoDefault(false);
  return button;
}

}  // namespace

DirectionPage::DirectionPage(QWidget* parent)
    : QWidget(parent),
      question_(new QLabel),
      right_(answerButton(tr("Yes, it does"))),
      wrong_(answerButton(tr("No, the other way"))) {
  question_->setWordWrap(true);
  question_->setFont(theme::uiFont(11, QFont::DemiBold));
  auto* answers = new QHBoxLayout;
  answers->addWidget(right_);
  answers->addWidget(wrong_);
  answers->addStretch(1);
  auto* hint = new QLabel(
      tr("The stick is held out of rest while you look. One that goes the other way is turned round here, and you look "
         "again. The rig does not arm before every stick has been looked at."));
  hint->setWordWrap(true);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(14);
  layout->addWidget(hint);
  layout->addWidget(question_);
  layout->addLayout(answers);
  layout->addStretch(1);
  connect(right_, &QPushButton::clicked, this, [this] { answer(true); });
  connect(wrong_, &QPushButton::clicked, this, [this] { answer(false); });
  renewal_.setInterval(kRenewalMs);
  connect(&renewal_, &QTimer::timeout, this, &DirectionPage::hold);
}

DirectionPage::~DirectionPage() = default;

void DirectionPage::begin(const TransmitterOptions& transmitter) {
  transmitter_ = transmitter;
  step_ = 0;
  look();
}

void DirectionPage::end() {
  renewal_.stop();
  sticks_.reset();
}

/// A process of its own for every look, as in flight: it begins at rest, with the channels as they are now.
void DirectionPage::look() {
  end();
  if (done()) return;
  const StickAxis axis = transmitter_.channels.all[static_cast<std::size_t>(step_)].axis;
  question_->setText(engineText(QString::fromLatin1(directionStep(axis).question)));
  wrong_->setEnabled(!isThrottle(axis));
  wrong_->setToolTip(isThrottle(axis)
                         ? tr("A throttle that goes the wrong way is turned round in the transmitter itself")
                         : QString());
  sticks_ = std::make_unique<HeldSticks>(transmitter_);
  renewal_.start();
}

void DirectionPage::hold() {
  const StickAxis axis = transmitter_.channels.all[static_cast<std::size_t>(step_)].axis;
  try {
    sticks_->hold(directionStep(axis).demand);
  } catch (const Error& error) {
    end();
    Q_EMIT failed(QString::fromUtf8(error.what()));
  }
}

void DirectionPage::answer(bool right) {
  if (done()) return;
  OutputChannel& channel = transmitter_.channels.all[static_cast<std::size_t>(step_)];
  if (right)
    ++step_;
  else
    channel.reverse = !channel.reverse;
  try {
    look();
  } catch (const Error& error) {
    Q_EMIT failed(QString::fromUtf8(error.what()));
    return;
  }
  if (done()) Q_EMIT finished();
}

QString DirectionPage::question() const {
  return question_->text();
}

}  // namespace helical
