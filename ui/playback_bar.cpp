#include "ui/playback_bar.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>
#include <algorithm>
#include <array>

#include "ui/playback_time_line.h"
#include "ui/theme.h"

namespace helical {
namespace {

constexpr std::array kSpeeds{0.1, 0.25, 0.5, 1.0, 2.0, 5.0, 10.0};
constexpr int kNormalSpeed = 3;

}  // namespace

PlaybackBar::PlaybackBar(FlightPlayback& playback, QWidget* parent)
    : QWidget(parent), playback_(playback), time_line_(new PlaybackTimeLine(playback)) {
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(8, 2, 8, 2);
  QToolButton* back = addButton(QStringLiteral("\u25c0|"), tr("A tick back"), QKeySequence(Qt::Key_Left));
  play_ = addButton(QStringLiteral("\u25b6"), tr("Play or pause"), QKeySequence(Qt::Key_Space));
  QToolButton* forth = addButton(QStringLiteral("|\u25b6"), tr("A tick forth"), QKeySequence(Qt::Key_Right));
  connect(back, &QToolButton::clicked, this, [this] { playback_.step(-1); });
  connect(play_, &QToolButton::clicked, this, &PlaybackBar::togglePlay);
  connect(forth, &QToolButton::clicked, this, [this] { playback_.step(1); });
  speed_ = new QComboBox;
  speed_->setAccessibleName(tr("Speed"));
  speed_->setToolTip(tr("Speed"));
  for (const double speed : kSpeeds) speed_->addItem(QStringLiteral("%1\u00d7").arg(speed));
  speed_->setCurrentIndex(kNormalSpeed);
  connect(speed_, &QComboBox::currentIndexChanged, this,
          [this](int index) { playback_.setSpeed(kSpeeds.at(static_cast<std::size_t>(index))); });
  layout->addWidget(speed_);
  layout->addWidget(time_line_, 1);
  mark_a_ =
      addButton(QStringLiteral("A"), tr("The loop begins here; again: no loop"), QKeySequence(Qt::Key_A));
  mark_b_ = addButton(QStringLiteral("B"), tr("The loop ends here; again: no loop"), QKeySequence(Qt::Key_B));
  mark_a_->setCheckable(true);
  mark_b_->setCheckable(true);
  connect(mark_a_, &QToolButton::clicked, this, [this] { setMark(true); });
  connect(mark_b_, &QToolButton::clicked, this, [this] { setMark(false); });
  time_ = new QLabel;
  time_->setFont(theme::monoFont(9));
  layout->addWidget(time_);
  refresh();
}

QToolButton* PlaybackBar::addButton(const QString& text, const QString& tip, const QKeySequence& key) {
  auto* button = new QToolButton;
  button->setText(text);
  button->setToolTip(tip + QStringLiteral(" (%1)").arg(key.toString(QKeySequence::NativeText)));
  button->setAccessibleName(tip);
  button->setShortcut(key);
  button->setObjectName(QStringLiteral("icon"));
  button->setFixedWidth(30);
  static_cast<QHBoxLayout*>(layout())->addWidget(button);
  return button;
}

void PlaybackBar::togglePlay() {
  if (playback_.playing())
    playback_.pause();
  else
    playback_.play();
  refresh();
}

void PlaybackBar::setMark(bool begin) {
  const bool set = (begin ? mark_a_ : mark_b_)->isChecked();
  FlightPlayback::Loop loop =
      playback_.loop().value_or(FlightPlayback::Loop{playback_.begin(), playback_.end()});
  if (begin)
    loop.from = set ? playback_.position() : playback_.begin();
  else
    loop.to = set ? playback_.position() : playback_.end();
  if (loop.to < loop.from) std::swap(loop.from, loop.to);
  const bool any = mark_a_->isChecked() || mark_b_->isChecked();
  playback_.setLoop(any ? std::optional(loop) : std::nullopt);
  refresh();
}

void PlaybackBar::refresh() {
  play_->setText(playback_.playing() ? QStringLiteral("\u2016") : QStringLiteral("\u25b6"));
  time_->setText(playbackTime(playback_.position() - playback_.begin()) + QStringLiteral(" / ") +
                 playbackTime(playback_.end() - playback_.begin()));
  time_line_->update();
}

}  // namespace helical
