#include "ui/top_bar.h"

#include <QCoreApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenuBar>
#include <QPushButton>
#include <array>

#include "ui/format.h"
#include "ui/hold_button.h"
#include "ui/preflight_popup.h"
#include "ui/status_chip.h"
#include "ui/status_words.h"
#include "ui/theme.h"

namespace helical {
namespace {

constexpr int kHeight = 48;
constexpr int kButtonHeight = 30;

QLabel* makeLabel(const QString& text, const QFont& font, const QColor& color) {
  auto* label = new QLabel(text);
  label->setFont(font);
  theme::setTextColor(*label, color);
  return label;
}

QFont brandFont() {
  QFont font = theme::uiFont(11.5, QFont::Bold);
  font.setLetterSpacing(QFont::AbsoluteSpacing, 2.2);
  return font;
}

template <class Button>
Button* dressed(Button* button, const QString& tip, const char* object_name) {
  button->setObjectName(QLatin1String(object_name));
  button->setToolTip(tip);
  button->setAccessibleName(button->text());
  button->setFont(theme::uiFont(9, QFont::DemiBold));
  button->setFixedHeight(kButtonHeight);
  // Space or Enter on a button that got the focus by accident must not start or stop a flight.
  button->setFocusPolicy(Qt::TabFocus);
  button->setAutoDefault(false);
  return button;
}

QPushButton* makeButton(const QString& text, const QString& tip, const char* object_name) {
  return dressed(new QPushButton(text), tip, object_name);
}

/// Qt would hand the focus of a button that goes off to the next one that is on, and the next Space would
/// land, or stop the rotors.
void enable(QPushButton& button, QPushButton& harmless, bool on) {
  if (!on && button.hasFocus()) harmless.setFocus(Qt::OtherFocusReason);
  button.setEnabled(on);
}

constexpr std::array kTransmitterWords{
    QT_TRANSLATE_NOOP("TopBar", "absent"), QT_TRANSLATE_NOOP("TopBar", "fault"),
    QT_TRANSLATE_NOOP("TopBar", "bench"), QT_TRANSLATE_NOOP("TopBar", "uncal."),
    QT_TRANSLATE_NOOP("TopBar", "ready")};

QString transmitterText(std::size_t index) {
  return QCoreApplication::translate("TopBar", kTransmitterWords.at(index));
}

/// Chips keep room for the longest word.
QString longestPilotWord() {
  EngineSnapshot pilot, engine;
  pilot.devices.transmitter.pilot_flies = true;
  engine.armed = true;
  QString longest;
  for (const EngineSnapshot& snapshot : {pilot, engine, EngineSnapshot{}})
    if (const QString text = pilotWord(snapshot).text; text.size() > longest.size()) longest = text;
  return longest;
}

QString longestTransmitterWord() {
  QString longest;
  for (std::size_t i = 0; i < kTransmitterWords.size(); ++i)
    if (const QString text = transmitterText(i); text.size() > longest.size()) longest = text;
  return longest;
}

StatusWord transmitterWord(const TransmitterStatus& status) {
  if (!status.present) return {transmitterText(0), theme::kDanger};
  if (status.fault || !status.self_test_passed) return {transmitterText(1), theme::kDanger};
  if (status.bench) return {transmitterText(2), theme::kCaution};
  if (!status.channels_calibrated) return {transmitterText(3), theme::kCaution};
  return {transmitterText(4), theme::kHealthy};
}

}  // namespace

TopBar::TopBar(const RigConfig& rig, QWidget* parent) : QWidget(parent), menu_bar_(new QMenuBar), rig_(rig) {
  setObjectName(QStringLiteral("topBar"));
  setAttribute(Qt::WA_StyledBackground);
  setFixedHeight(kHeight);
  readiness_ = new QPushButton(tr("Starting"));
  readiness_->setFocusPolicy(Qt::TabFocus);
  readiness_->setAutoDefault(false);
  readiness_->setToolTip(tr("Click for the pre-flight list"));
  preflight_ = new PreflightPopup(this);
  connect(readiness_, &QPushButton::clicked, this, [this] { preflight_->openBelow(*readiness_); });
  readiness_->setFont(theme::capsFont(10, QFont::Bold));
  readiness_->setFixedHeight(kButtonHeight);
  readiness_->setMinimumWidth(QFontMetrics(readiness_->font()).horizontalAdvance(tr("Descending").toUpper()) +
                              36);
  readiness_->setAccessibleName(tr("Readiness"));
  mode_ = makeLabel({}, theme::capsFont(7.2), theme::kMuted);
  cameras_ = new StatusChip(tr("Tracked"), QStringLiteral("16/16"));
  cameras_->setToolTip(tr("Cameras that help the pose now, of all in the rig"));
  engine_ = new StatusChip(tr("Engine"), QStringLiteral("60.0 Hz"));
  engine_->setToolTip(tr("Control ticks per second"));
  transmitter_ = new StatusChip(tr("Radio"), longestTransmitterWord());
  transmitter_->setToolTip(tr("The transmitter, from what it last said"));
  pilot_ = new StatusChip(tr("Flies"), longestPilotWord());
  pilot_->setToolTip(
      tr("Whose sticks the helicopter obeys: Helical's, or those of the pilot, who takes over by the trainer "
         "switch"));
  time_ = new StatusChip(tr("Flight"), QStringLiteral("00:00.0"));
  time_->setToolTip(tr("Since the rotors started"));
  buildButtons();

  menu_bar_->setFont(theme::uiFont(9));
  menu_bar_->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(14, 0, 10, 1);
  layout->setSpacing(8);
  layout->addWidget(makeLabel(QStringLiteral("HELICAL"), brandFont(), theme::kText));
  layout->addWidget(makeLabel(tr("Ground Control"), theme::uiFont(10.5), theme::kMuted));
  layout->addSpacing(10);
  layout->addWidget(menu_bar_);
  layout->addStretch(1);
  layout->addWidget(mode_);
  layout->addSpacing(6);
  layout->addWidget(readiness_);
  for (QWidget* widget :
       {static_cast<QWidget*>(cameras_), static_cast<QWidget*>(engine_), static_cast<QWidget*>(transmitter_),
        static_cast<QWidget*>(pilot_), static_cast<QWidget*>(time_)})
    layout->addWidget(widget);
  layout->addSpacing(6);
  for (QWidget* widget : std::initializer_list<QWidget*>{arm_, take_off_, hold_, land_, stop_})
    layout->addWidget(widget);
}

void TopBar::buildButtons() {
  arm_ = dressed(new HoldButton(tr("Arm")), tr("Hold it down for a second: then the rotors may turn"), "arm");
  arm_->setEnabled(false);
  connect(arm_, &HoldButton::held, this, [this] { Q_EMIT armRequested(true); });
  connect(arm_, &QPushButton::clicked, this, [this] {
    if (armed_) Q_EMIT armRequested(false);
  });
  hold_ = makeButton(tr("Hold"), tr("Stay where it is; again: fly on"), "hold");
  hold_->setEnabled(false);
  connect(hold_, &QPushButton::clicked, this, [this] {
    if (holding_)
      Q_EMIT takeOffRequested();  // in the air that ends a hold
    else
      Q_EMIT holdRequested();
  });
  take_off_ = makeButton(tr("Take off"),
                         tr("Start the flight plan; the readiness word tells what is missing"), "takeOff");
  land_ = makeButton(tr("Land"), tr("Land where it is"), "land");
  stop_ = makeButton(tr("STOP"), tr("Rotors off at once (Esc). It falls from where it is, and stays off."),
                     "stop");
  stop_->setFont(theme::uiFont(10, QFont::Bold));
  take_off_->setEnabled(false);
  land_->setEnabled(false);
  connect(take_off_, &QPushButton::clicked, this, &TopBar::takeOffRequested);
  connect(land_, &QPushButton::clicked, this, &TopBar::landRequested);
  // Not on release: a STOP must not wait for the finger to come up.
  connect(stop_, &QPushButton::pressed, this, &TopBar::stopRequested);
  connect(stop_, &QPushButton::clicked, this, &TopBar::stopRequested);
}

QString TopBar::readiness() const {
  return readiness_->text();
}

void TopBar::setReadiness(const EngineSnapshot& snapshot) {
  const StatusWord word = readinessWord(snapshot);
  if (word.text == readiness_->text() && readiness_->property("color").value<QColor>() == word.color) return;
  readiness_->setText(word.text);
  readiness_->setProperty("color", word.color);
  const bool danger = word.color == theme::kDanger;
  const QColor& c = word.color;
  readiness_->setStyleSheet(
      QStringLiteral("background: rgba(%1,%2,%3,%4); border: 1px solid rgba(%1,%2,%3,150);"
                     "border-radius: 4px; color: %5;")
          .arg(c.red())
          .arg(c.green())
          .arg(c.blue())
          .arg(danger ? 200 : 36)
          .arg(danger ? QStringLiteral("#ffffff") : c.name()));
}

void TopBar::show(const EngineSnapshot& snapshot) {
  setReadiness(snapshot);
  preflight_->show(preflightList(rig_, snapshot));
  mode_->setText(snapshot.has_truth ? tr("Simulation") : tr("Live"));
  const int tracked = trackedCameras(snapshot);
  const QColor cameras_color = tracked == 0                      ? theme::kCaution
                               : tracked < snapshot.camera_count ? theme::kActive
                                                                 : theme::kHealthy;
  cameras_->set(QStringLiteral("%1/%2").arg(tracked).arg(snapshot.camera_count), cameras_color);
  engine_->set(tr("%1 Hz").arg(plainNumber(snapshot.ticks_per_second, 1)),
               snapshot.ticks_per_second > 0.9 * rig_.control.rate_hz ? theme::kHealthy : theme::kCaution);
  time_->set(snapshot.flight_time_s > 0.0 ? clockText(fromSeconds(snapshot.flight_time_s)) : kNoValue,
             inFlight(snapshot.phase) ? theme::kActive : theme::kFaint);
  const StatusWord radio = transmitterWord(snapshot.devices.transmitter);
  transmitter_->set(radio.text, radio.color);
  const StatusWord pilot = pilotWord(snapshot);
  pilot_->set(pilot.text, pilot.color);
  enableButtons(snapshot);
}

QString TopBar::pilot() const {
  return pilot_->value();
}

void TopBar::enableButtons(const EngineSnapshot& snapshot) {
  const bool cut = snapshot.safety == SafetyState::kCut;
  armed_ = snapshot.armed;
  holding_ = snapshot.holding;
  arm_->setText(armed_ ? tr("Disarm") : tr("Arm"));
  arm_->setAccessibleName(arm_->text());
  arm_->setToolTip(armed_ ? tr("Forbid the rotors to turn")
                          : tr("Hold it down for a second: then the rotors may turn"));
  arm_->setHoldNeeded(!armed_);
  enable(*arm_, *readiness_, !cut && snapshot.phase == FlightPhase::kIdle);
  enable(*take_off_, *readiness_, !cut && snapshot.armed && snapshot.phase == FlightPhase::kIdle);
  hold_->setText(holding_ ? tr("Fly on") : tr("Hold"));
  hold_->setAccessibleName(hold_->text());
  enable(*hold_, *readiness_, !cut && snapshot.phase == FlightPhase::kFlying);
  enable(*land_, *readiness_,
         !cut && (snapshot.phase == FlightPhase::kLiftOff || snapshot.phase == FlightPhase::kFlying));
}

}  // namespace helical
