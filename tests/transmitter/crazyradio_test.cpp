// The radio behind an unmodified libusb. No time is measured: `now` is the tests' own.

#include "engine/transmitter/crazyradio.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/base/error.h"
#include "tests/transmitter/emulated_bus.h"
#include "tests/transmitter/emulated_crazyradio.h"

namespace helical {
namespace {

constexpr TimeNs kTick = 10 * kNanosecondsPerMillisecond;
constexpr std::uint8_t kSetPoint = 0x3C, kSupervisor = 0x9D;

class CrazyradioTest : public testing::Test {
 protected:
  CrazyradioTest() : device_(std::make_shared<EmulatedCrazyradio>()), port_(bus_.plug(5, device_)) {}

  static UsbWanted wanted(int timeout_ms = 10'000) {
    UsbWanted one = Crazyradio::wanted("");
    one.timeout_ms = timeout_ms;
    return one;
  }

  EmulatedBus bus_;
  std::shared_ptr<EmulatedCrazyradio> device_;
  std::unique_ptr<EmulatedPort> port_;
};

TEST_F(CrazyradioTest, SetsTheRadioUp) {
  RadioOptions options;
  options.channel = 101;
  options.rate_kbps = 1000;
  options.address = {0xE7, 0x01, 0x02, 0x03, 0x04};
  options.power = 2;
  Crazyradio radio(wanted(), options, radioChannels());
  radio.send({}, 0);
  ASSERT_FALSE(radio.status().fault);
  EXPECT_EQ(device_->settings[0x01], 101);
  EXPECT_EQ(device_->settings[0x03], 1);
  EXPECT_EQ(device_->settings[0x04], 2);
  EXPECT_EQ(device_->settings[0x05], 0xA0);
  EXPECT_EQ(device_->settings[0x06], 3);
  EXPECT_EQ(device_->settings[0x10], 1);
  EXPECT_EQ(device_->settings[0x20], 0);
  EXPECT_EQ(device_->address, UsbBytes({0xE7, 0x01, 0x02, 0x03, 0x04}));
}

TEST_F(CrazyradioTest, PacketsAreExactToTheByte) {
  Crazyradio radio(wanted(), {}, radioChannels());
  radio.send({}, 0);
  // Throttle 0.5, yaw 0.25 to the left, roll 0.5, pitch 0.75: 30000; 50 deg/s, 10 and 15 degrees.
  radio.send({0.375, 0.625, 0.5, 0.75}, kTick);
  const UsbBytes rest{0x3C, 0, 0, 0, 0, 0, 0, 0, 0x80, 0, 0, 0, 0x80, 0, 0};
  const UsbBytes flying{0x3C, 0x00, 0x00, 0x20, 0x41,  // 10.0f
                        0x00, 0x00, 0x70, 0xC1,        // -15.0f: its pitch is positive nose up
                        0x00, 0x00, 0x48, 0xC2,        // -50.0f: its yaw is positive to the right
                        0x30, 0x75};                   // 30000
  EXPECT_THAT(device_->packets,
              testing::ElementsAre(UsbBytes({0x9D, 0x04}), rest, UsbBytes({0x9D, 0x01, 0x01}), flying));
}

TEST_F(CrazyradioTest, ThrustStaysWithinWhatTheFirmwareTakes) {
  OutputChannels channels = radioChannels();
  Crazyradio radio(wanted(), {}, channels);
  radio.send({1.0, 1.0, 0.0, 0.0}, 0);
  radio.send({0.01, 0.01, 0.0, 0.0}, kTick);
  const auto points = device_->packetsOf(kSetPoint);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0][13] | points[0][14] << 8, 60000);
  EXPECT_EQ(points[1][13] | points[1][14] << 8, 0) << "under 1000 its motors stop";
}

TEST_F(CrazyradioTest, FeedsTheWatchdogFiveTimesASecondAndArmsWithTheRotors) {
  Crazyradio radio(wanted(), {}, radioChannels());
  for (int i = 0; i < 100; ++i) radio.send({0.4, 0.4, 0.0, 0.0}, i * kTick);
  for (int i = 100; i < 200; ++i) radio.send({}, i * kTick);
  const auto orders = device_->packetsOf(kSupervisor);
  EXPECT_EQ(std::count(orders.begin(), orders.end(), UsbBytes({0x9D, 0x04})), 10);
  EXPECT_EQ(std::count(orders.begin(), orders.end(), UsbBytes({0x9D, 0x01, 0x01})), 1);
  EXPECT_EQ(std::count(orders.begin(), orders.end(), UsbBytes({0x9D, 0x01, 0x00})), 1);
  EXPECT_EQ(device_->packetsOf(kSetPoint).size(), 200u);
}

/// For 10 ms to 5 s: every demand that is not acknowledged is a fault, none is left out, and all is well at once when the
/// helicopter hears again.
TEST_F(CrazyradioTest, LostAcknowledgementsAreAFaultForAsLongAsTheyAreLost) {
  Crazyradio radio(wanted(), {}, radioChannels());
  TimeNs now = 0;
  const auto send = [&] { radio.send({0.4, 0.4, 0.0, 0.0}, now += kTick); };
  send();
  for (const int lost_ms : {10, 50, 200, 1000, 5000}) {
    device_->hears = false;
    const std::size_t before = device_->packetsOf(kSetPoint).size();
    for (int ms = 0; ms < lost_ms; ms += 10) {
      send();
      ASSERT_TRUE(radio.status().fault);
      ASSERT_TRUE(radio.status().present);
      ASSERT_EQ(radio.status().trouble, TransmitterTrouble::kNotAcknowledged);
    }
    EXPECT_EQ(device_->packetsOf(kSetPoint).size(), before + static_cast<std::size_t>(lost_ms / 10));
    device_->hears = true;
    send();
    ASSERT_FALSE(radio.status().fault) << "after " << lost_ms << " ms";
  }
}

TEST_F(CrazyradioTest, AnAnswerThatComesLateIsNotTakenForTheNextOnes) {
  Crazyradio radio(wanted(1000), {}, radioChannels());
  radio.send({}, 0);
  device_->late_answers = 1;
  radio.send({}, kTick);
  EXPECT_EQ(radio.status().trouble, TransmitterTrouble::kTimedOut);
  device_->release();
  device_->hears = false;
  radio.send({}, 2 * kTick);
  EXPECT_EQ(radio.status().trouble, TransmitterTrouble::kNotAcknowledged) << "not the good answer of an earlier one";
}

TEST_F(CrazyradioTest, UnpluggedItIsGone) {
  Crazyradio radio(wanted(), {}, radioChannels());
  radio.send({}, 0);
  EXPECT_TRUE(radio.status().present);
  port_->unplug();
  radio.send({0.4, 0.4, 0.0, 0.0}, kTick);
  EXPECT_FALSE(radio.status().present);
  EXPECT_EQ(radio.status().trouble, TransmitterTrouble::kAbsent);
}

TEST(RadioOptions, AreValidated) {
  EXPECT_NO_THROW(validate(RadioOptions{}));
  const RadioOptions usual;
  for (RadioOptions wrong : {RadioOptions{126, 2000, usual.address, 3}, RadioOptions{-1, 2000, usual.address, 3},
                             RadioOptions{80, 500, usual.address, 3}, RadioOptions{80, 2000, usual.address, 4}})
    EXPECT_THROW(validate(wrong), Error);
}

}  // namespace
}  // namespace helical
