// The guided calibration of a transmitter's channels by keyboard and mouse, with an emulated analogue output.

// Before Qt, whose word "signals" GLib has as a name.
#include "tests/transmitter/emulated_bus.h"
#include "tests/transmitter/emulated_mcc.h"

#include "ui/channels_dialog.h"

#include <gtest/gtest.h>

#include <QAbstractSpinBox>
#include <QCheckBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QLineEdit>
#include <QPushButton>
#include <QRadioButton>
#include <QSpinBox>
#include <QTest>
#include <optional>

#include "engine/base/error.h"
#include "engine/transmitter/output_device.h"
#include "ui/channel_page.h"
#include "ui/direction_page.h"

namespace helical {
namespace {

constexpr int kDialogPatienceMs = 20'000;

class ChannelsDialogTest : public testing::Test {
 protected:
  ChannelsDialogTest() : device_(std::make_shared<EmulatedMcc>()), port_(bus_.plug(5, device_)) {}

  void open(const std::string& kind = kMccDevice) {
    TransmitterOptions transmitter;
    transmitter.kind = kind;
    dialog_ = std::make_unique<ChannelsDialog>(transmitter, [this](const OutputChannels& channels, bool checked) {
      if (refuse_) throw Error(ErrorKind::kSystem, "the disk is full", "rig.toml", "make room");
      saved_ = channels;
      checked_ = checked;
    });
    dialog_->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(dialog_.get()));
  }
  void click(QAbstractButton* button) {
    QTest::mouseClick(button, Qt::LeftButton, {}, QPoint(8, button->height() / 2));
  }
  void next() { click(dialog_->nextButton()); }
  /// As somebody does who types over what is there, and presses Enter.
  void type(QAbstractSpinBox* box, const QString& text) {
    box->setFocus();
    box->selectAll();
    QTest::keyClicks(box, text);
    QTest::keyClick(box, Qt::Key_Return);
  }
  bool eventually(const std::function<bool()>& condition) { return QTest::qWaitFor(condition, kDialogPatienceMs); }
  void save(const QString& name) {
    const QString folder = QStringLiteral(HELICAL_PICTURE_DIR);
    ASSERT_TRUE(QDir().mkpath(folder));
    ASSERT_TRUE(dialog_->grab().save(folder + "/" + name + ".png"));
  }

  EmulatedBus bus_;
  std::shared_ptr<EmulatedMcc> device_;
  std::unique_ptr<EmulatedPort> port_;
  std::unique_ptr<ChannelsDialog> dialog_;
  std::optional<OutputChannels> saved_;
  bool checked_ = false;
  bool refuse_ = false;
};

TEST_F(ChannelsDialogTest, GuidesThroughEveryChannelTriesWhatIsTypedAndLooksAtTheDirections) {
  open();
  EXPECT_FALSE(dialog_->nextButton()->isEnabled()) << "not before the motors are off";
  save("channels_begin");
  click(dialog_->motorsOff());
  ASSERT_TRUE(dialog_->nextButton()->isEnabled());
  next();
  ChannelPage* throttle = dialog_->page();
  ASSERT_NE(throttle, nullptr) << dialog_->problem().toStdString();
  EXPECT_EQ(throttle->axis(), StickAxis::kThrottle);
  EXPECT_EQ(throttle->output()->maximum(), 7);
  EXPECT_FALSE(throttle->reverse()->isEnabled()) << "a throttle is never reversed";
  type(throttle->output(), "2");
  type(throttle->lowEnd(), "0.3");
  EXPECT_NEAR(device_->volts(2), 0.3, 0.01) << "at once";
  type(throttle->neutral(), "2");
  type(throttle->highEnd(), "4.6");
  EXPECT_NEAR(device_->volts(2), 4.6, 0.01);
  save("channels_throttle");
  next();
  EXPECT_NEAR(device_->volts(2), 0.3, 0.01) << "a throttle left alone is at rest";
  ASSERT_EQ(dialog_->page()->axis(), StickAxis::kYaw);
  type(dialog_->page()->trim(), "0.1");
  EXPECT_NEAR(device_->volts(1), 2.6, 0.01);
  next();
  ChannelPage* roll = dialog_->page();
  ASSERT_EQ(roll->axis(), StickAxis::kRoll);
  type(roll->output(), "0");
  click(roll->reverse());
  EXPECT_EQ(roll->lowEnd()->value(), 4.5);
  EXPECT_EQ(roll->highEnd()->value(), 0.5);
  next();
  type(dialog_->page()->slew(), "20");
  type(dialog_->page()->output(), "3");
  next();
  ASSERT_EQ(dialog_->page(), nullptr);
  EXPECT_EQ(dialog_->problem().toStdString(), "");
  DirectionPage& directions = dialog_->directions();
  EXPECT_TRUE(directions.question().startsWith("throttle:"));
  EXPECT_EQ(dialog_->nextButton()->text(), "Skip") << "and then the rig does not arm";
  EXPECT_FALSE(directions.wrongButton()->isEnabled());
  save("channels_directions");
  ASSERT_TRUE(eventually([this] { return device_->volts(2) > 1.0; })) << "a third";
  click(directions.rightButton());
  click(directions.rightButton());
  EXPECT_TRUE(directions.question().startsWith("roll:"));
  click(directions.wrongButton());
  EXPECT_TRUE(directions.question().startsWith("roll:")) << "it is looked at again";
  click(directions.rightButton());
  click(directions.rightButton());
  ASSERT_TRUE(directions.done());
  EXPECT_EQ(dialog_->nextButton()->text(), "Save");
  refuse_ = true;
  next();
  EXPECT_TRUE(dialog_->problem().contains("the disk is full")) << dialog_->problem().toStdString();
  EXPECT_TRUE(dialog_->isVisible());
  refuse_ = false;
  next();
  ASSERT_TRUE(saved_.has_value());
  EXPECT_TRUE(checked_);
  EXPECT_FALSE(dialog_->isVisible());
  const auto& all = saved_->all;
  ASSERT_EQ(saved_->count, 4);
  EXPECT_EQ(all[0].output, 2);
  EXPECT_EQ(all[0].minimum, 0.3);
  EXPECT_EQ(all[0].maximum, 4.6);
  EXPECT_NEAR(all[1].trim, 0.1, 1e-9);
  EXPECT_FALSE(all[2].reverse) << "turned round twice";
  EXPECT_EQ(all[2].minimum, 0.5);
  EXPECT_EQ(all[3].slew_per_s, 20.0);
}

TEST_F(ChannelsDialogTest, RefusesChannelsThatContradictEachOtherAndSaysWhy) {
  open();
  click(dialog_->motorsOff());
  click(dialog_->rotorsButton());
  next();
  ASSERT_NE(dialog_->page(), nullptr) << dialog_->problem().toStdString();
  EXPECT_EQ(dialog_->page()->axis(), StickAxis::kUpperRotor);
  for (int i = 0; i < 3; ++i) next();
  ASSERT_EQ(dialog_->page()->axis(), StickAxis::kPitch);
  type(dialog_->page()->output(), "0");  // the upper rotor's
  next();
  EXPECT_NE(dialog_->page(), nullptr) << "it stays here";
  EXPECT_NE(dialog_->problem(), "");
  EXPECT_FALSE(saved_.has_value());
  click(dialog_->backButton());
  EXPECT_EQ(dialog_->page()->axis(), StickAxis::kRoll);
  EXPECT_EQ(dialog_->problem(), "");
}

TEST_F(ChannelsDialogTest, SaysThatTheDeviceIsMissingOrLost) {
  port_->unplug();
  open();
  click(dialog_->motorsOff());
  next();
  EXPECT_NE(dialog_->problem(), "");
  EXPECT_EQ(dialog_->page(), nullptr) << "it stays where it is";
  port_ = bus_.plug(6, device_);
  next();
  ASSERT_NE(dialog_->page(), nullptr);
  EXPECT_EQ(dialog_->problem().toStdString(), "");
  port_->unplug();
  type(dialog_->page()->highEnd(), "4.2");
  EXPECT_NE(dialog_->problem(), "");
  QTest::keyClick(dialog_.get(), Qt::Key_Escape);
  EXPECT_FALSE(dialog_->isVisible());
  EXPECT_FALSE(saved_.has_value()) << "given up: nothing changes";
}

TEST_F(ChannelsDialogTest, EveryControlHasANameAndATabStop) {
  open();
  click(dialog_->motorsOff());
  next();
  for (const QWidget* widget : dialog_->findChildren<QWidget*>()) {
    const bool control = qobject_cast<const QAbstractButton*>(widget) || qobject_cast<const QAbstractSpinBox*>(widget);
    if (!control || !widget->isVisible()) continue;
    EXPECT_NE(widget->accessibleName(), "") << widget->metaObject()->className();
    EXPECT_NE(widget->focusPolicy() & Qt::TabFocus, 0);
  }
}

}  // namespace
}  // namespace helical
